//! `fields/open_in_paraview.py`: opens the fields in ParaView with range, camera and colours set.

use crate::numeric::written::significant;
use crate::simulate::result::{FieldFrame, Member, Run};

/// Half the height of the view, in modules.
const HALF_HEIGHT: f64 = 4.0;
/// Share of the nodes in view whose stress lies within the colours; under a contact it is far larger than anywhere else.
const IN_RANGE: f64 = 0.99;
/// Factor on the displacements.
const WARP: f64 = 10.0;

const SCRIPT: &str = r#"# Opens these fields in ParaView, coloured by von Mises stress, the contact in view, displacements WARP times enlarged.
#   File > Load State..., or: paraview --script=open_in_paraview.py, or: pvpython open_in_paraview.py picture.png
import os
import sys

from paraview.simple import *

try:
    here = os.path.dirname(os.path.abspath(__file__))
except NameError:
    here = os.getcwd()  # ParaView was started in this folder
if not os.path.isfile(os.path.join(here, "wear.pvd")):
    raise SystemExit("wear.pvd is not in " + here + ": start ParaView in the folder of this script")

series = PVDReader(FileName=os.path.join(here, "wear.pvd"))
RenameSource("wear.pvd", series)
view = GetActiveViewOrCreate("RenderView")
view.OrientationAxesVisibility = 0
if len(sys.argv) > 1:
    view.ViewSize = [1200, 800]

scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.GoToLast()

warp = WarpByVector(Input=series)
warp.Vectors = ["POINTS", "displacement"]
warp.ScaleFactor = WARP
Hide(series, view)
shown = Show(warp, view)
shown.Representation = "Surface"
shown.NonlinearSubdivisionLevel = 2
ColorBy(shown, ("POINTS", "von_mises"))
colours = GetColorTransferFunction("von_mises")
colours.ApplyPreset("Viridis (matplotlib)", True)
colours.RescaleTransferFunction(0.0, TOP)
colours.AutomaticRescaleRangeMode = "Never"
shown.SetScalarBarVisibility(view, True)
bar = GetScalarBar(colours, view)
bar.Title = "von Mises, MPa"
bar.ComponentTitle = ""
bar.Orientation = "Vertical"
bar.WindowLocation = "Any Location"
bar.Position = [0.88, 0.3]
bar.ScalarBarLength = 0.4
bar.ScalarBarThickness = 14
bar.TitleFontSize = bar.LabelFontSize = 14
bar.AutomaticLabelFormat = 0
bar.LabelFormat = bar.RangeLabelFormat = "%.0f"

# the first picture of a view moves the camera: the contact is looked at after it
Render(view)
view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraPosition = [X, Y, 100.0]
view.CameraFocalPoint = [X, Y, 0.0]
view.CameraViewUp = [0.0, 1.0, 0.0]
view.CameraParallelScale = HALF_HEIGHT
Render(view)
if len(sys.argv) > 1 and sys.argv[1].endswith(".png"):
    SaveScreenshot(sys.argv[1], view, ImageResolution=[1200, 800])
"#;

/// The script; None without contact in any state.
pub fn paraview(run: &Run) -> Option<String> {
    let last = run.fields.iter().rfind(|frame| contact(frame).is_some())?;
    let first_of_last = run.fields.iter().find(|frame| frame.cycles == last.cycles);
    let frame = first_of_last
        .filter(|f| contact(f).is_some())
        .unwrap_or(last);
    let [x, y] = contact(frame)?;
    let half = HALF_HEIGHT * run.geometry.module;
    let number = |value: f64| format!("{value:.4}");
    let top =
        significant(largest_shown(frame, [x, y], half).max(1e-3), 2).replace(['\u{202f}', ' '], "");
    let script = SCRIPT
        .replace("[X, Y,", &format!("[{}, {},", number(x), number(y)))
        .replace("HALF_HEIGHT", &number(half))
        .replace("WARP", &WARP.to_string())
        .replace("TOP", &top);
    Some(script)
}

/// A node's worn place in the fixed frame, mm.
fn place(frame: &FieldFrame, member: Member, node: usize) -> [f64; 2] {
    let field = frame.member(member);
    let (sin, cos) = field.rotation.sin_cos();
    let [x, y] = field.worn[node];
    [
        field.centre[0] + cos * x - sin * y,
        field.centre[1] + sin * x + cos * y,
    ]
}

/// Where the pressure on the pinion is largest; None where nothing touches.
fn contact(frame: &FieldFrame) -> Option<[f64; 2]> {
    let pressure = &frame.pinion.contact_pressure;
    let node = (0..pressure.len()).max_by(|&i, &j| pressure[i].total_cmp(&pressure[j]))?;
    (pressure[node] > 0.0).then(|| place(frame, Member::Pinion, node))
}

/// The stress below which most nodes in view lie, MPa.
fn largest_shown(frame: &FieldFrame, [x, y]: [f64; 2], half: f64) -> f64 {
    let mut seen: Vec<f64> = Vec::new();
    for member in Member::BOTH {
        let stress = frame.member(member).von_mises.iter().enumerate();
        seen.extend(stress.filter_map(|(node, stress)| {
            let [px, py] = place(frame, member, node);
            ((px - x).abs() < half && (py - y).abs() < half).then_some(*stress)
        }));
    }
    seen.sort_by(f64::total_cmp);
    let at = (IN_RANGE * seen.len().saturating_sub(1) as f64) as usize;
    seen.get(at).copied().unwrap_or(0.0)
}
