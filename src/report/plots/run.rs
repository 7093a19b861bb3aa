//! The plots of one run.
use super::{Plot, Style, sliding};
use crate::numeric::written::count;
use crate::simulate::result::{Member, PairState, Run, State};

/// Wear and contact; those without data left out.
pub fn of_run(run: &Run) -> Vec<Plot> {
    let mut plots = wear_of_run(run);
    plots.extend(contact_of_run(run));
    plots
}

/// Wear along both flanks, growth of the depth.
pub fn wear_of_run(run: &Run) -> Vec<Plot> {
    let plots = [
        wear(run, Member::Pinion),
        wear(run, Member::Gear),
        growth(run),
        face_load(run),
        face_depth(run),
    ];
    plots.into_iter().filter(|plot| !plot.is_empty()).collect()
}

/// Peak pressure, load share, transmission error and sliding over the mesh cycle.
pub fn contact_of_run(run: &Run) -> Vec<Plot> {
    let mut plots = vec![peak_pressure(run), load_share(run), transmission_error(run)];
    plots.push(over_a_turn(run));
    plots.extend(sliding::of_run(run));
    if run.states.iter().any(|s| s.pairs().any(|p| p.at_corner)) {
        plots.push(corner_pressure(run));
    }
    plots.into_iter().filter(|plot| !plot.is_empty()).collect()
}

/// Film ratio, flash temperature and power lost along the path of contact; those that do not follow from the study left out.
pub fn oil_and_heat_of_run(run: &Run) -> Vec<Plot> {
    let film = Plot::new(
        "film_ratio",
        "Film ratio: smallest film thickness over the composite roughness",
        PATH,
        "film ratio, -",
    );
    let flash = Plot::new(
        "flash_temperature",
        "Rise of the contact temperature over the bulk",
        PATH,
        "flash temperature, K",
    );
    let power = Plot::new(
        "friction_power",
        "Power that friction takes at one tooth pair",
        PATH,
        "power, W",
    );
    let plots = [
        along_path_where(film, run, |pair| pair.sliding.film_ratio),
        along_path_where(flash, run, |pair| pair.sliding.flash_temperature),
        along_path_where(power, run, |pair| pair.sliding.power),
    ];
    plots.into_iter().filter(|plot| !plot.is_empty()).collect()
}

/// The states that a page with scripts can be moved through: at most 40, the first and the last among them.
pub fn live_states(run: &Run) -> Vec<usize> {
    chosen(run.states.len(), 40)
}

pub(super) const PATH: &str = "distance along the path of contact from the pitch point, mm";

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
    let style = |index, count| Style::Time { index, count };
    for (index, &state) in shown.iter().enumerate() {
        let label = cycles_label(states[state]);
        let points = depths(states[state], member);
        plot = plot.curve(&label, style(index, shown.len()), points);
    }
    let live = live_states(run);
    for (index, &number) in live.iter().enumerate() {
        let state = &run.states[number];
        // each state in a place of its own: the earlier ones stay in sight
        plot = plot.live(
            Some((index, "")),
            &cycles_label(state),
            style(index, live.len()),
            depths(state, member),
        );
    }
    plot.history = true;
    plot
}

/// Depth over path, path ascending.
pub(in crate::report) fn depths(state: &State, member: Member) -> Vec<(f64, f64)> {
    let flank = state.profile(member);
    let mut points: Vec<(f64, f64)> = flank
        .path
        .iter()
        .copied()
        .zip(flank.depth.iter().copied())
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
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

const FACE: &str = "place across the face from its middle, mm";

/// Load across the face, where it has slices.
fn face_load(run: &Run) -> Plot {
    let mut plot = Plot::new(
        "face_load",
        "Load per width across the face over its mean",
        FACE,
        "load over mean, -",
    )
    .starting_at_zero();
    for (kind, state) in ends(run).into_iter().enumerate() {
        let points = state.slices.iter().map(|slice| (slice.face, slice.load));
        plot = plot.curve(&cycles_label(state), Style::Kind(kind), points.collect());
    }
    plot
}

/// Largest depth of every slice in the last state.
fn face_depth(run: &Run) -> Plot {
    let mut plot = Plot::new(
        "face_depth",
        "Largest worn depth across the face",
        FACE,
        "largest worn depth, µm",
    )
    .starting_at_zero();
    for (side, member) in Member::BOTH.into_iter().enumerate() {
        let deepest = |depth: &[f64]| depth.iter().fold(0.0, |m: f64, h| m.max(*h));
        let slices = run.last().slices.iter();
        let points = slices.map(|slice| (slice.face, deepest(&slice.depth[side])));
        plot = plot.curve(member.name(), Style::Kind(side), points.collect());
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

/// Pressures at sharp corners would leave the flanks' no room: they stand in a plot of their own.
fn peak_pressure(run: &Run) -> Plot {
    let mut plot = corner_pressure(run);
    plot.name = "peak_pressure".to_owned();
    plot.title = "Largest contact pressure of one tooth pair, away from tip corners".to_owned();
    plot.curves
        .retain(|curve| !matches!(curve.style, Style::Points(_)));
    plot.live
        .retain(|live| !matches!(live.curve.style, Style::Points(_)));
    plot
}

fn corner_pressure(run: &Run) -> Plot {
    let plot = Plot::new(
        "corner_pressure",
        "Largest contact pressure of one tooth pair, at tip corners its mean over 0.02 modules",
        PATH,
        "peak pressure, MPa",
    );
    along_path(plot, run, |pair| pair.peak_pressure)
}

/// First and last state; the pairs that touch with a tip corner as crosses of the same colour.
fn along_path(plot: Plot, run: &Run, value: impl Fn(&PairState) -> f64) -> Plot {
    along_path_where(plot, run, |pair| Some(value(pair)))
}

/// The same, of the pairs that have a value.
fn along_path_where(plot: Plot, run: &Run, value: impl Fn(&PairState) -> Option<f64>) -> Plot {
    let mut plot = plot.with_marks(letters(run)).starting_at_zero();
    let gather = |state: &State, at_corner: bool| {
        let mut points: Vec<(f64, f64)> = state
            .pairs()
            .filter(|pair| pair.line_load > 0.0 && pair.at_corner == at_corner)
            .filter_map(|pair| Some((pair.path, value(pair)?)))
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    };
    for (kind, state) in ends(run).into_iter().enumerate() {
        let (label, at_corner) = (cycles_label(state), corner_label(state));
        plot = plot.curve(&label, Style::Kind(kind), gather(state, false));
        plot = plot.curve(&at_corner, Style::Points(kind), gather(state, true));
    }
    over_states(plot, run, |plot, kind, at, state| {
        let (label, at_corner) = (cycles_label(state), corner_label(state));
        let [inside, corner] = [at.map(|i| (i, "flank")), at.map(|i| (i, "corner"))];
        plot.live(inside, &label, Style::Kind(kind), gather(state, false))
            .live(corner, &at_corner, Style::Points(kind), gather(state, true))
    })
}

/// Live curves: the first state for good, and in a place of its own whichever state is asked for.
fn over_states<'r>(
    plot: Plot,
    run: &'r Run,
    add: impl Fn(Plot, usize, Option<usize>, &'r State) -> Plot,
) -> Plot {
    if run.states.len() < 2 {
        return plot;
    }
    let plot = add(plot, 0, None, run.first());
    let states = live_states(run).into_iter().enumerate().skip(1);
    states.fold(plot, |plot, (index, number)| {
        add(plot, 1, Some(index), &run.states[number])
    })
}

fn transmission_error(run: &Run) -> Plot {
    let mut plot = Plot::new(
        "transmission_error",
        "Lag of the gear under load over one base pitch",
        "pinion rotation from the pitch point, base pitches",
        "lag seen at the pinion, µrad",
    );
    let angles = |state: &State| -> Vec<(f64, f64)> {
        let cycle = state.cycle.iter();
        cycle.map(|p| (p.position, p.angle_urad)).collect()
    };
    for (kind, state) in ends(run).into_iter().enumerate() {
        plot = plot.curve(&cycles_label(state), Style::Kind(kind), angles(state));
    }
    over_states(plot, run, |plot, kind, at, state| {
        let at = at.map(|i| (i, "angle"));
        plot.live(at, &cycles_label(state), Style::Kind(kind), angles(state))
    })
}

/// Empty where all teeth are alike and no member runs out.
fn over_a_turn(run: &Run) -> Plot {
    let plot = Plot::new(
        "transmission_error_turn",
        "Lag of the gear under load over one turn of the member with more teeth",
        "pinion rotation since the first teeth met in the pitch point, base pitches",
        "lag seen at the pinion, µrad",
    );
    let states = ends(run).into_iter().enumerate();
    states
        .filter(|(_, state)| !state.turn.is_empty())
        .fold(plot, |plot, (kind, state)| {
            let points = state
                .turn
                .iter()
                .map(|[rotation, angle]| (*rotation, *angle));
            plot.curve(&cycles_label(state), Style::Kind(kind), points.collect())
        })
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
pub(super) fn letters(run: &Run) -> Vec<(f64, String)> {
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

fn corner_label(state: &State) -> String {
    format!("{}, tip corner", cycles_label(state))
}
