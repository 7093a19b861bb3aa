//! Where the teeth of a member stand: pitch deviations tooth by tooth.

/// How far the teeth of both members stand back from their places, and how finely they are told apart.
///
/// Teeth are numbered from 0 in the order in which they come into mesh; tooth 0 of the pinion meets tooth 0 of the gear.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Teeth {
    /// mm along the path of contact by member and tooth, positive: the tooth stands back; empty where all stand in their places.
    pub back: [Vec<f64>; 2],
    /// The most classes of teeth whose wear is computed for itself, by member; none: [`Teeth::USUAL_CLASSES`].
    pub classes: [Option<usize>; 2],
    /// Which tooth meets which.
    pub hunting: Hunting,
}

/// Which mates a tooth meets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Hunting {
    /// A mate that is the mean of all that it meets.
    #[default]
    Average,
    /// Each of them, one after the other.
    Full,
}

impl Teeth {
    /// The most classes of a member unless the study says otherwise.
    pub const USUAL_CLASSES: usize = 12;

    /// The most meetings of two teeth that [`Hunting::Full`] takes.
    pub const MOST_MEETINGS: usize = 256;

    /// Whether all teeth of both members stand alike.
    pub fn are_alike(&self) -> bool {
        let alike = |back: &Vec<f64>| back.windows(2).all(|two| two[0] == two[1]);
        self.back.iter().all(alike)
    }

    /// How many meetings of two teeth there are until all begins again: the least common multiple of the numbers of teeth.
    pub fn meetings(teeth: [usize; 2]) -> usize {
        teeth[0] / common_factor(teeth) * teeth[1]
    }
}

/// The greatest common factor of the numbers of teeth: 1 where every tooth meets every other.
pub fn common_factor([a, b]: [usize; 2]) -> usize {
    if b == 0 { a } else { common_factor([b, a % b]) }
}
