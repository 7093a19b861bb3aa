//! Which rows may lie on one smooth surface over position and cycles.

use super::observation::{FacePlace, Observation};
use super::quantity::{Quantity, Subject};

/// What rows that may lie on one smooth surface over position and cycles have in common: test, member, quantity and place across the face.
pub type Surface = (usize, Subject, Quantity, Option<u64>);

/// Places across the face that are told apart: where an areal measurement has more, its rows go by as many equal strips.
const PLACES: usize = 8;

/// The surface of every row.
pub fn surfaces(rows: &[&Observation]) -> Vec<Surface> {
    let places = rows.iter().filter_map(|o| match o.face {
        Some(FacePlace::At(face)) => Some(face),
        Some(FacePlace::Mean) | None => None,
    });
    let mut places: Vec<f64> = places.map(|face| face + 0.0).collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    let strip = match places.as_slice() {
        [first, .., last] if places.len() > PLACES => {
            let width = (last - first) / PLACES as f64;
            Some((*first, width))
        }
        _ => None,
    };
    let of_face = |face: FacePlace| match (face, strip) {
        (FacePlace::At(face), Some((first, width))) => {
            (((face - first) / width) as u64).min(PLACES as u64 - 1)
        }
        _ => face.key(),
    };
    let of_row = |o: &&Observation| (o.test, o.member, o.quantity, o.face.map(of_face));
    rows.iter().map(of_row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(face: Option<FacePlace>) -> Observation {
        Observation {
            test: 0,
            member: Subject::Pinion,
            cycles: 1e5,
            quantity: Quantity::WearDepth,
            position: Some(26.0),
            value: 1.0,
            sigma: 0.1,
            trace: None,
            face,
            tooth: None,
            line: 2,
        }
    }

    fn count(rows: &[Observation]) -> usize {
        let mut all = surfaces(&rows.iter().collect::<Vec<_>>());
        all.sort_unstable();
        all.dedup();
        all.len()
    }

    #[test]
    fn places_across_the_face_are_surfaces_and_areal_measurements_strips() {
        let places = |faces: &[f64]| -> Vec<Observation> {
            let of = |&face: &f64| at(Some(FacePlace::At(face)));
            faces.iter().map(of).collect()
        };
        assert_eq!(count(&places(&[-10.0, 0.0, -0.0, 10.0, 10.0])), 3);
        let mut mixed = places(&[0.0]);
        mixed.extend([at(None), at(Some(FacePlace::Mean)), at(None)]);
        assert_eq!(count(&mixed), 3);
        let areal: Vec<f64> = (0..200).map(|i| -15.0 + 0.15 * f64::from(i)).collect();
        assert_eq!(count(&places(&areal)), PLACES);
    }
}
