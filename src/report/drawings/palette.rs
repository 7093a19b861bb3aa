//! Colours of stresses.

/// The viridis map (van der Walt and Smith 2015) at eighths, dark to bright.
pub(super) const MAP: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 45, 123],
    [59, 82, 139],
    [44, 114, 142],
    [33, 145, 140],
    [40, 174, 128],
    [94, 201, 98],
    [173, 220, 48],
    [253, 231, 37],
];

/// Colours of the levels 0 to 255; level 0 is where there is nothing.
pub(super) fn palette() -> Vec<[u8; 3]> {
    (0..256)
        .map(|level: usize| {
            let at = level.saturating_sub(1) as f64 / 254.0 * (MAP.len() - 1) as f64;
            let i = (at as usize).min(MAP.len() - 2);
            let mix = |j: usize| {
                let [a, b] = [MAP[i][j], MAP[i + 1][j]].map(f64::from);
                (a + (at - i as f64) * (b - a)).round() as u8
            };
            [mix(0), mix(1), mix(2)]
        })
        .collect()
}
