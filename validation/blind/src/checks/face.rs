//! Slices of the face against closed forms and a small model of springs.

use super::tests::reference;
use crate::layout::{Layout, Place, middle};
use crate::passage::Fineness;
use crate::wear::{Memory, Run};

/// Loads of the slices over their mean at a position, new flanks.
fn shares(run: &Run, i: usize) -> Vec<f64> {
    let a = run.contact(0, i, &vec![0.0; run.size()], &mut Vec::new());
    let slots = run.passage().positions[i].slots.len();
    let each: Vec<f64> = a.loads.chunks(slots).map(|l| l.iter().sum()).collect();
    let mean = each.iter().sum::<f64>() / each.len() as f64;
    assert!((mean / run.line_load() - 1.0).abs() < 1e-9);
    each.iter().map(|w| w / mean).collect()
}

/// A position where one pair carries, of new flanks without a lead; and the approach there under a line load.
fn alone(torque: f64) -> (usize, f64) {
    let (run, _) = reference(Fineness::default(), torque);
    let state = vec![0.0; run.size()];
    let single = |i: &usize| {
        let a = run.contact(0, *i, &state, &mut Vec::new());
        a.loads
            .iter()
            .any(|w| (w / run.line_load() - 1.0).abs() < 1e-9)
    };
    let all: Vec<usize> = (0..run.passage().positions.len()).filter(single).collect();
    let i = all[all.len() / 2];
    (i, run.contact(0, i, &state, &mut Vec::new()).approach)
}

/// Without a lead every slice wears as the one section does, from any state of wear: 1e-12 of the largest rate.
#[test]
fn even_slices_are_one_section() {
    let (one, _) = reference(Fineness::default(), 100.0);
    let (mut many, _) = reference(Fineness::default(), 100.0);
    many.layout = Layout::face(4, &|_| 0.0);
    let worn = one.run(3e5).at(3e5);
    let mut copies = Vec::new();
    for m in 0..2 {
        (0..4).for_each(|_| copies.extend(one.flank(&worn, m, 0)));
    }
    let rate = |run: &Run, worn: &[f64]| {
        run.rate(0.0, worn, &vec![0.0; worn.len()], &mut Memory::default())
    };
    let (a, b) = (rate(&one, &worn), rate(&many, &copies));
    let top = a.iter().copied().fold(0.0, f64::max);
    for m in 0..2 {
        for q in 0..4 {
            let pairs = one.flank(&a, m, 0).iter().zip(many.flank(&b, m, q));
            let worst = pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-12 * top, "{m} {q}: {worst} of {top}");
        }
    }
    assert!((one.mass(&worn, 0) / many.mass(&copies, 0) - 1.0).abs() < 1e-12);
}

/// A thin wedge on straight springs: w(eta)/w = 1 + eta c F/(2 w), the linear bedding of K_Hbeta. c is the slope of the single section's load over its
/// approach (by two loads); 0.1 % of the mean load.
#[test]
fn thin_wedge() {
    let torque = 100.0;
    let (i, _) = alone(torque);
    let (mut run, _) = reference(Fineness::default(), torque);
    // Loads 2 % off: the approach at the same position, its grid made for the same torque.
    let mut approach = |t: f64| {
        run.conditions.torque = t;
        run.contact(0, i, &vec![0.0; run.size()], &mut Vec::new())
            .approach
    };
    let (low, high) = (approach(98.0), approach(102.0));
    run.conditions.torque = torque;
    let slope = 0.04 * run.line_load() / (high - low);
    let (slices, wedge) = (9, 0.4);
    run.layout = Layout::face(slices, &|eta| -0.5 * wedge * eta);
    for (q, w) in shares(&run, i).iter().enumerate() {
        let straight = 1.0 + 0.5e-3 * wedge * middle(q, slices) * slope / run.line_load();
        assert!((w - straight).abs() < 1e-3, "{q}: {w} {straight}");
    }
}

/// A wedge that opens part of the face, and a crown, on springs whose law is the single section's load over its approach, read from single sections
/// under many loads: the turn that carries the torque by bisection. Slices 2 % of the mean load (the law is read straight between loads).
#[test]
fn wide_leads_on_springs() {
    let torque = 100.0;
    let (i, _) = alone(torque);
    let (mut run, _) = reference(Fineness::default(), torque);
    let w = run.line_load();
    let law: Vec<(f64, f64)> = (1..=120)
        .map(|k| {
            run.conditions.torque = torque * 0.025 * f64::from(k);
            let load = run.line_load();
            (
                run.contact(0, i, &vec![0.0; run.size()], &mut Vec::new())
                    .approach,
                load,
            )
        })
        .collect();
    run.conditions.torque = torque;
    let load = |approach: f64| {
        if approach <= law[0].0 {
            return (approach / law[0].0).max(0.0) * law[0].1;
        }
        let k = law
            .partition_point(|l| l.0 < approach)
            .clamp(1, law.len() - 1);
        let (a, b) = (law[k - 1], law[k]);
        a.1 + (b.1 - a.1) * (approach - a.0) / (b.0 - a.0)
    };
    let slices = 9;
    let leads: [&dyn Fn(f64) -> f64; 2] = [&|eta| -15.0 * eta, &|eta| 12.0 * eta * eta];
    for (lead, opens) in leads.into_iter().zip([true, false]) {
        run.layout = Layout::face(slices, lead);
        let found = shares(&run, i);
        let back = |q: usize| 1e-3 * lead(middle(q, slices));
        let mean =
            |turn: f64| (0..slices).map(|q| load(turn - back(q))).sum::<f64>() / slices as f64;
        let (mut low, mut high) = (-0.1, 0.1);
        for _ in 0..80 {
            let mid = 0.5 * (low + high);
            if mean(mid) < w { low = mid } else { high = mid }
        }
        for (q, found) in found.iter().enumerate() {
            let spring = load(low - back(q)) / w;
            assert!((found - spring).abs() < 0.02, "{q}: {found} {spring}");
        }
        assert_eq!(found.contains(&0.0), opens);
    }
}

/// A wedge wears even: the worn areas of all slices differ by what the wedge lacks, and both members lose what Reye's sum asks. After deep wear the difference in
/// depth between the ends, both flanks together, nears the wedge where flanks slide.
#[test]
fn a_wedge_wears_even() {
    let (mut run, pair) = reference(Fineness::default(), 100.0);
    let wedge = 6.0;
    let slices = 5;
    run.layout = Layout::face(slices, &|eta| -0.5 * wedge * eta);
    let history = run.run(1.2e7);
    let (s, ratio) = (0.5 * pair.end, pair.pinion.z as f64 / pair.gear.z as f64);
    let both = |n: f64, q: usize| {
        let state = history.at(n);
        let depth = |m: usize| {
            let t = pair.teeth(m);
            run.passage().stations[m].sample(run.flank(&state, m, q), t.arc(pair.rho(m, s)))
        };
        1e3 * (depth(0) + depth(1))
    };
    let apart = |n: f64| both(n, slices - 1) - both(n, 0);
    let whole = wedge * (middle(slices - 1, slices) - middle(0, slices)) / 2.0;
    assert!(apart(3e5) < 0.7 * whole);
    assert!(
        (apart(1.2e7) / whole - 1.0).abs() < 0.03,
        "{} {whole}",
        apart(1.2e7)
    );
    let area = run.worn_area(&history.at(1.2e7));
    assert!((area[0] * ratio / area[1] - 1.0).abs() < 1e-3);
}

/// Places on a wedge of depth: what is read at mid-face, between slices and as a mean.
#[test]
fn places_across_the_face() {
    let layout = Layout::face(9, &|_| 0.0);
    let read = |place| {
        let parts = layout.at(0, place);
        parts
            .iter()
            .map(|&(q, w)| w * (3.0 + 2.0 * middle(q, 9)))
            .sum::<f64>()
    };
    for (place, value) in [
        (Place::Usual, 3.0),
        (Place::Mean, 3.0),
        (Place::Face(0.85), 4.7),
        (Place::Face(-1.0), 1.0),
        (Place::Face(1.0), 5.0),
    ] {
        assert!((read(place) - value).abs() < 1e-12, "{place:?}");
    }
}
