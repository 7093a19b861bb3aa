//! The plots of one run.
use super::{Plot, Style};
use crate::report::format::count;
use crate::simulate::result::{Member, PairState, Run, State};

/// Wear along both flanks, load share, peak pressure, transmission error, growth of the depth; those without data left out.
pub fn of_run(run: &Run) -> Vec<Plot> {
    let mut plots = vec![
        wear(run, Member::Pinion),
        wear(run, Member::Gear),
        growth(run),
    ];
    plots.extend([load_share(run), peak_pressure(run), transmission_error(run)]);
    plots.retain(|plot| !plot.is_empty());
    plots
}

const PATH: &str = "distance along the path of contact from the pitch point, mm";

fn wear(run: &Run, member: Member) -> Plot {
    let name = member.name();
    let mut plot = Plot::new(
        &format!("wear_{name}"),
        &format!("Worn depth along the {name}'s loaded flank"),
        PATH,
        "worn depth, µm",
    )
    .with_marks(letters(run))
    .starting_at_zero();
    // An unworn flank is a line along the axis: left out unless there is nothing else.
    let worn: Vec<&State> = run
        .states
        .iter()
        .filter(|state| state.profile(member).max_depth() > 0.0)
        .collect();
    let states = if worn.is_empty() {
        vec![run.last()]
    } else {
        worn
    };
    let shown = chosen(states.len(), 6);
    for (index, &state) in shown.iter().enumerate() {
        let state = states[state];
        let flank = state.profile(member);
        let mut points: Vec<(f64, f64)> = flank
            .path
            .iter()
            .copied()
            .zip(flank.depth.iter().copied())
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        plot = plot.curve(
            &cycles_label(state),
            Style::Time {
                index,
                count: shown.len(),
            },
            points,
        );
    }
    plot
}

fn growth(run: &Run) -> Plot {
    let mut plot = Plot::new(
        "depth_growth",
        "Largest worn depth against cycles",
        "pinion revolutions",
        "largest worn depth, µm",
    )
    .starting_at_zero();
    if run.states.len() < 2 {
        return plot;
    }
    for (kind, member) in Member::BOTH.into_iter().enumerate() {
        let points = run
            .states
            .iter()
            .map(|state| (state.cycles, state.profile(member).max_depth()))
            .collect();
        plot = plot.curve(member.name(), Style::Kind(kind), points);
    }
    plot
}

fn load_share(run: &Run) -> Plot {
    let plot = Plot::new(
        "load_share",
        "Share of the load that one tooth pair carries",
        PATH,
        "load share, -",
    );
    along_path(plot, run, |pair| pair.load_share)
}

fn peak_pressure(run: &Run) -> Plot {
    let plot = Plot::new(
        "peak_pressure",
        "Largest contact pressure of one tooth pair",
        PATH,
        "peak pressure, MPa",
    );
    along_path(plot, run, |pair| pair.peak_pressure)
}

/// First and last state; the pairs that touch with a tip corner as crosses of the same colour.
fn along_path(plot: Plot, run: &Run, value: impl Fn(&PairState) -> f64) -> Plot {
    let mut plot = plot.with_marks(letters(run)).starting_at_zero();
    for (kind, state) in ends(run).into_iter().enumerate() {
        let gather = |at_corner: bool| {
            let mut points: Vec<(f64, f64)> = state
                .pairs()
                .filter(|pair| pair.line_load > 0.0 && pair.at_corner == at_corner)
                .map(|pair| (pair.path, value(pair)))
                .collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            points
        };
        plot = plot.curve(&cycles_label(state), Style::Kind(kind), gather(false));
        let label = format!("{}, tip corner", cycles_label(state));
        plot = plot.curve(&label, Style::Points(kind), gather(true));
    }
    plot
}

fn transmission_error(run: &Run) -> Plot {
    let mut plot = Plot::new(
        "transmission_error",
        "Lag of the gear under load over one base pitch",
        "pinion rotation from the pitch point, base pitches",
        "lag seen at the pinion, µrad",
    );
    for (kind, state) in ends(run).into_iter().enumerate() {
        let points = state
            .cycle
            .iter()
            .map(|p| (p.position, p.angle_urad))
            .collect();
        plot = plot.curve(&cycles_label(state), Style::Kind(kind), points);
    }
    plot
}

/// The first and the last state, or the only one.
fn ends(run: &Run) -> Vec<&State> {
    if run.states.len() > 1 {
        vec![run.first(), run.last()]
    } else {
        vec![run.first()]
    }
}

/// A, B, C, D, E at the ends of contact, of single contact, and at the pitch point.
fn letters(run: &Run) -> Vec<(f64, String)> {
    let [a, b, d, e] = run.geometry.path_limits;
    [(a, "A"), (b, "B"), (0.0, "C"), (d, "D"), (e, "E")]
        .map(|(at, letter)| (at, letter.to_owned()))
        .to_vec()
}

/// At most `most` of `count` indices, first and last among them, evenly apart.
fn chosen(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most)
        .map(|i| (i * (count - 1) + (most - 1) / 2) / (most - 1))
        .collect()
}

fn cycles_label(state: &State) -> String {
    format!("{} cycles", count(state.cycles))
}
