//! Both gears to scale with their line of action, whole and at the mesh.
use super::{Drawing, opened, path};
use crate::gear::{Gear, Member, Pair, ProfileResolution};
use crate::numeric::Vec2;

/// Pieces of each part of a tooth's side: smooth at several pixels per tenth of a millimetre.
const FINE: ProfileResolution = ProfileResolution {
    root: 3,
    fillet: 8,
    involute: 14,
    rounding: 4,
    tip: 3,
};
/// Width of either drawing, pixels.
const WIDTH: f64 = 640.0;
const INK: &str = "var(--ink,#1c1f23)";
const SOFT: &str = "var(--soft,#5a626b)";
const FILLS: [&str; 2] = ["var(--tooth1,#dbe8f2)", "var(--tooth2,#f6e3d6)"];
const PATH: &str = "var(--k1,#d55e00)";

/// The whole pair, and its mesh magnified; tooth 0 of both touches at the pitch point.
pub fn of_pair(pair: &Pair) -> Vec<Drawing> {
    let tips = [pair.pinion.tip_radius, pair.gear.tip_radius];
    let highest = tips[0].max(tips[1]);
    let air = 0.02 * pair.centre_distance;
    let whole = View {
        corner: Vec2::new(-tips[0] - air, highest + air),
        scale: WIDTH / (pair.centre_distance + tips[0] + tips[1] + 2.0 * air),
        height: 2.0 * (highest + air),
    };
    let half = 0.62 * pair.path_length + pair.pinion.rack.module;
    let pitch = pair.contact_point(0.0);
    let mesh = View {
        corner: pitch + Vec2::new(-half, 0.8 * half),
        scale: WIDTH / (2.0 * half),
        height: 1.6 * half,
    };
    let drawings = [
        (
            "gear_pair",
            "The pair to scale: pinion left, driving; pitch circles dashed, line of action dotted, path of contact thick",
            whole,
            false,
        ),
        (
            "gear_mesh",
            if pair.base_helix == 0.0 {
                "Where the teeth meet: contact runs along the thick line from A to E, a single pair carries from B to D"
            } else {
                "Where the teeth meet, a transverse section: contact runs along the thick line from A to E, a single pair touches there from B to D"
            },
            mesh,
            true,
        ),
    ];
    drawings
        .into_iter()
        .map(|(name, title, view, letters)| Drawing {
            name: name.to_owned(),
            title: title.to_owned(),
            content: drawn(pair, &view, letters, title),
            attributes: String::new(),
        })
        .collect()
}

/// What part of the fixed frame is seen: its upper left corner, mm; pixels per mm; its height, mm.
struct View {
    corner: Vec2,
    scale: f64,
    height: f64,
}

impl View {
    fn at(&self, p: Vec2) -> [f64; 2] {
        [
            self.scale * (p.x - self.corner.x),
            self.scale * (self.corner.y - p.y),
        ]
    }
}

fn drawn(pair: &Pair, view: &View, letters: bool, title: &str) -> String {
    let mut svg = opened([WIDTH, view.scale * view.height], title);
    for (side, member) in [Member::Pinion, Member::Gear].into_iter().enumerate() {
        svg.push_str(&wheel(pair, member, side, view));
    }
    let line = |from: f64, to: f64, style: &str| {
        let ends = [from, to].map(|y| view.at(pair.contact_point(y)));
        format!("<path d=\"{}\" fill=\"none\" {style}/>\n", path(ends))
    };
    let [a, .., e] = pair.path_points();
    let (t1, t2) = (-pair.rho_c, pair.line_length - pair.rho_c);
    svg.push_str(&line(
        t1,
        t2,
        &format!("stroke=\"{INK}\" stroke-width=\"1.2\" stroke-dasharray=\"2 3\""),
    ));
    svg.push_str(&line(
        a,
        e,
        &format!("stroke=\"{PATH}\" stroke-width=\"3.5\""),
    ));
    if letters {
        svg.push_str(&lettered(pair, view));
    }
    svg + "</svg>\n"
}

/// A, C and E below the line of action, B and D above it, each with a dot.
fn lettered(pair: &Pair, view: &View) -> String {
    let n = pair.normal();
    let mut out = String::new();
    for (i, (y, letter)) in pair
        .path_points()
        .into_iter()
        .zip("ABCDE".chars())
        .enumerate()
    {
        let [x, up] = view.at(pair.contact_point(y));
        let side = if i % 2 == 0 { 17.0 } else { -17.0 };
        // across the line of action, which is (n.x, −n.y) on the screen
        let (tx, ty) = (x + side * n.y, up + side * n.x + 6.0);
        out.push_str(&format!(
            "<circle cx=\"{x:.1}\" cy=\"{up:.1}\" r=\"4.5\" fill=\"{PATH}\"/><text x=\"{tx:.1}\" y=\"{ty:.1}\" font-size=\"18\" \
             font-weight=\"bold\" text-anchor=\"middle\" fill=\"{INK}\">{letter}</text>\n"
        ));
    }
    out
}

/// One gear: its teeth as copies of one, bore, pitch circle.
fn wheel(pair: &Pair, member: Member, side: usize, view: &View) -> String {
    let gear: &Gear = pair.member(member);
    let (centre, angle, pitch) = match member {
        Member::Pinion => (0.0, pair.pinion_angle(0.0), pair.pitch_radius_pinion),
        Member::Gear => (
            pair.centre_distance,
            pair.gear_angle(0.0),
            pair.pitch_radius_gear,
        ),
    };
    let s = view.scale;
    let [cx, cy] = view.at(Vec2::new(centre, 0.0));
    // in pixels, y up: the group flips it
    let tooth = path(gear.tooth_profile(FINE).iter().map(|p| [s * p.x, s * p.y]));
    let fill = FILLS[side];
    let id = format!("{}-{}", member.name(), (10.0 * s) as u32);
    let mut out = format!(
        "<g transform=\"translate({cx:.2} {cy:.2}) scale(1 -1) rotate({:.5})\">\n<defs><path id=\"{id}\" d=\"{tooth}\"/></defs>\n\
         <circle r=\"{:.2}\" fill=\"{fill}\"/>\n",
        angle.to_degrees(),
        s * gear.root_radius
    );
    for i in 0..gear.spec.teeth {
        let turn = (f64::from(i) * gear.pitch_angle()).to_degrees();
        out.push_str(&format!(
            "<use href=\"#{id}\" transform=\"rotate({turn:.4})\" fill=\"{fill}\" stroke=\"{INK}\" stroke-width=\"1\"/>\n"
        ));
    }
    let (bore, pitch) = (s * gear.bore_radius(), s * pitch);
    out + &format!(
        "<circle r=\"{bore:.2}\" fill=\"var(--page,#ffffff)\" stroke=\"{INK}\" stroke-width=\"1\"/>\n\
         <circle r=\"{pitch:.2}\" fill=\"none\" stroke=\"{SOFT}\" stroke-width=\"1\" stroke-dasharray=\"7 5\"/>\n</g>\n"
    )
}
