//! Writes the ready meshes of `meshes/` that come from our own mesher: `cargo run --example ready_meshes`.

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;

use gearwear::gear::{BasicRack, Gear, ToothSpec};
use gearwear::mesh::{MeshSpec, Quality, mesh_gear};

#[expect(clippy::print_stdout, reason = "says what it wrote")]
fn main() -> Result<(), Box<dyn Error>> {
    // Name, teeth, bore (mm), curvature radius where the fine part starts (mm): the reference pair, a little below the active profile.
    for (name, teeth, bore, from) in [("pinion_27", 27, 25.0, 3.9), ("gear_53", 53, 40.0, 13.2)] {
        let gear = Gear::new(BasicRack::iso53_a(2.0), ToothSpec::plain(teeth, bore))?;
        let spec = MeshSpec {
            coarse_spacing: 1.6,
            root_spacing: 0.25,
            growth: 0.5,
            ..MeshSpec::new(&gear, vec![-1, 0], 0.08, from)
        };
        let mesh = mesh_gear(&gear, &spec)?;
        let path = format!("{}/meshes/{name}.vtu", env!("CARGO_MANIFEST_DIR"));
        let q = Quality::of(&mesh);
        mesh.to_vtk(name)
            .write_xml(BufWriter::new(File::create(path)?))?;
        println!("{name}: {q:?}");
        assert!(q.min_angle_deg > 20.0 && q.nodes < 12_000, "{q:?}");
    }
    Ok(())
}
