//! Floor 1: spur gear geometry: basic rack, tooth flanks, working pair, path of contact.
//!
//! Member frame: the gear's centre at the origin, tooth 0 centred on the +x axis, teeth numbered counter-clockwise.
//! The loaded flank is the counter-clockwise flank of each tooth (for both members; the gear's own frame is turned by
//! 180° against the fixed one). A point of the involute is named by its radius of curvature `rho`, mm: the distance to the
//! base circle along the tangent, so that r² = r_b² + rho² and the arc length along the involute is rho²/(2 r_b).
