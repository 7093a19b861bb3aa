//! Fields for ParaView: one `.vtu` per stored wear state and mesh position, both members in it, and `.pvd` series over them.
//!
//! ```text
//! points   worn, unloaded position in the fixed frame: pinion's centre at its own place, gear's at the centre distance
//! cells    triangles, linear (VTK type 5) or quadratic (22)
//! arrays   member (0 pinion, 1 gear), displacement, stress, von_mises, contact_pressure, contact_force, wear_depth,
//!          wear_vector (worn minus unworn position), member_position (unworn position in the member's own frame)
//! ```
//! Vectors and tensors are turned into the fixed frame. The stress tensor has six components in ParaView's order XX YY ZZ XY
//! YZ XZ. Units mm, N, MPa; `wear_depth` µm. Warp by `displacement` or `wear_vector` times a factor to see either.
//!
//! Points, pressure, contact force are doubles, so that load and area can be recomputed from the file; the other arrays are
//! single precision (7 digits), which halves the file. Arrays are compressed and appended in binary: a third of the size of base 64.
mod flanks;
mod grid;
mod loads;
mod series;
mod state;
mod xml;

pub use flanks::flank_surfaces;
pub use grid::{vtu, xml};
pub use loads::loads;
pub use series::{FieldFile, mesh_cycle_series, names, pvd, wear_series};
pub use state::paraview;
