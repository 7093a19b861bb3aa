//! A made-up run whose loads and areas have closed forms. Shapes resemble a gear pair; no solver is involved.
use gearwear::mesh::Cells;
use gearwear::simulate::result::*;

/// Half width of the made-up contact, mm.
pub(crate) const HALF_WIDTH: f64 = 0.08;
/// Largest pressure of the made-up contact, MPa.
pub(crate) const PEAK: f64 = 850.0;
/// Sagitta of each back edge of the made-up meshes, mm.
pub(crate) const SAGITTA: f64 = 0.003;
/// Edges along the contact side; rows.
pub(crate) const COLUMNS: usize = 8;
pub(crate) const ROWS: usize = 4;

const LIMITS: [f64; 4] = [-5.2094, -1.0932, 0.6949, 4.8110];
const BASE: [f64; 2] = [25.371_70, 49.803_71];
const PITCH: [f64; 2] = [27.0, 53.0];

/// The whole made-up run: 5 states, 3 of them drawn, the last at three mesh positions.
pub(crate) fn run() -> Run {
    let cycles = [0.0, 5_000.0, 15_000.0, 30_000.0, 50_000.0];
    Run {
        title: "Made-up pair <27/53> & \"quotes\"".to_owned(),
        conditions: Conditions {
            test: None,
            model: "fem".to_owned(),
            effects: vec!["running_in(amplitude = 3, decay_cycles = 2e5)".to_owned()],
            torque: 100_000.0,
            speed_rpm: 2000.0,
            misalignment: 0.0,
            wear_coefficient: [6e-10; 2],
            cycles: 50_000.0,
            face_width: 33.0,
            youngs_modulus: [2.1e5; 2],
            poisson_ratio: [0.3; 2],
            density: [7850.0; 2],
            friction: Friction::default(),
            warmed_teeth_c: None,
        },
        geometry: geometry(),
        made: Made::default(),
        mesh: Some([mesh_summary(24_310), mesh_summary(31_877)]),
        states: cycles.iter().map(|&n| state(n)).collect(),
        fields: vec![
            frame(0.0, 0.0),
            frame(15_000.0, 0.0),
            frame(50_000.0, -0.25),
            frame(50_000.0, 0.0),
            frame(50_000.0, 0.25),
        ],
        root_stress: Some([148.8, 122.8].map(|stress| RootStress {
            stress,
            radius: 24.8,
            path: 0.69,
        })),
        balance_error: 3.2e-4,
        checks: vec![
            Check {
                name: "torque balance, relative".to_owned(),
                value: 4e-12,
                limit: 1e-6,
                unit: "-".to_owned(),
            },
            Check {
                name: "largest penetration".to_owned(),
                value: 2e-8,
                limit: 1e-3,
                unit: "µm".to_owned(),
            },
        ],
        cost: Cost {
            seconds: 1.37,
            factorisations: 2,
            contact_solves: 12_345,
            wear_steps: 17,
            peak_memory_mb: Some(312.5),
            threads: 2,
            stages: vec![
                ("mesh".to_owned(), 0.3),
                ("factor".to_owned(), 0.5),
                ("wear".to_owned(), 0.57),
            ],
        },
    }
}

fn geometry() -> Geometry {
    let wheel = |i: usize, teeth: u32, tip: f64, root: f64, form: f64, active: f64, bore: f64| {
        WheelGeometry {
            teeth,
            profile_shift: 0.0,
            base_radius: BASE[i],
            pitch_radius: PITCH[i],
            tip_radius: tip,
            root_radius: root,
            form_radius: form,
            active_radius: active,
            bore_radius: bore,
        }
    };
    Geometry {
        module: 2.0,
        pressure_angle_deg: 20.0,
        helix: None,
        centre_distance: 80.0,
        working_pressure_angle_deg: 20.0,
        contact_ratio: 1.69714,
        path_of_contact: 10.0204,
        base_pitch: 5.90426,
        backlash_um: 0.0,
        speed_ratio: 53.0 / 27.0,
        path_limits: LIMITS,
        pinion: wheel(0, 27, 29.0, 24.5, 25.5968, 25.689, 12.5),
        gear: wheel(1, 53, 55.0, 50.5, 51.2952, 51.72, 20.0),
    }
}

fn mesh_summary(nodes: usize) -> MeshSummary {
    MeshSummary {
        element: "T6".to_owned(),
        nodes,
        elements: nodes / 2,
        dof: 2 * nodes,
        min_angle_deg: 25.3,
        flank_spacing: 0.01,
        edges_per_half_width: 5.0,
    }
}

fn state(cycles: f64) -> State {
    let worn = 1.0 - (-cycles / 40_000.0).exp();
    let profile = |sign: f64, member: usize, scale: f64| {
        let count = 201;
        let path: Vec<f64> = (0..count)
            .map(|i| LIMITS[0] + (LIMITS[3] - LIMITS[0]) * i as f64 / (count - 1) as f64)
            .map(|y| y * sign)
            .collect();
        let mut path = path;
        path.sort_by(f64::total_cmp);
        let rho = |y: f64| BASE[member] * 20f64.to_radians().tan() + y * sign;
        Profile {
            radius: path.iter().map(|&y| BASE[member].hypot(rho(y))).collect(),
            depth: path
                .iter()
                .map(|&y| scale * worn * (y.abs() / 5.0).powf(0.8) + 0.02 * worn)
                .collect(),
            worn_area_mm2: 0.004 * worn * scale,
            mass_loss_mg: 30.0 * worn * scale,
            path,
        }
    };
    let (pinion, mut gear) = (profile(1.0, 0, 2.4), profile(-1.0, 1, 0.7));
    // Along the gear's flank the radius grows against the path.
    gear.radius.reverse();
    gear.radius.sort_by(f64::total_cmp);
    gear.path.reverse();
    gear.depth.reverse();
    let positions = 40;
    let cycle = (0..positions)
        .map(|i| position(i as f64 / positions as f64, worn))
        .collect();
    State {
        cycles,
        pinion,
        gear,
        cycle,
        slices: Vec::new(),
        teeth: Vec::new(),
        turn: Vec::new(),
    }
}

fn position(position: f64, worn: f64) -> PositionState {
    let base_pitch = 5.90426;
    let load = 119.436;
    let pairs: Vec<(i32, f64)> = [-1, 0, 1]
        .into_iter()
        .map(|pair| (pair, (position + f64::from(pair)) * base_pitch))
        .filter(|&(_, path)| (LIMITS[0]..=LIMITS[3]).contains(&path))
        .collect();
    let single = pairs.len() == 1;
    let pairs = pairs
        .into_iter()
        .map(|(pair, path)| {
            let share = if single {
                1.0
            } else {
                0.5 - path.signum() * (path.abs() - 2.95) * 0.09
            };
            PairState {
                pair,
                path,
                load_share: share,
                line_load: share * load,
                peak_pressure: 846.8 * share.sqrt() * (1.0 - 0.02 * path - 0.1 * worn),
                half_width: 0.0897 * share.sqrt(),
                off_line_of_action: path < LIMITS[0] + 0.3,
                at_corner: path < LIMITS[0] + 0.3,
                over_kink: false,
                face: None,
                sliding: Sliding {
                    speed: 0.315 * path.abs(),
                    film_ratio: Some(0.2 + 0.01 * path),
                    flash_temperature: None,
                    friction: Some(0.06),
                    power: Some(0.06 * share * load * 33.0 * 0.315 * path.abs()),
                },
            }
        })
        .collect();
    let angle_urad = if single {
        344.56
    } else {
        245.0 + 5.0 * (position * 9.0).sin()
    } + 30.0 * worn;
    PositionState {
        position,
        angle_urad,
        pairs,
    }
}

/// Line load of the made-up contact, N/mm: the integral of the parabola `PEAK (1 − (s/b)²)`, 4/3 p b.
pub(crate) fn line_load() -> f64 {
    4.0 / 3.0 * PEAK * HALF_WIDTH
}

/// Area of one made-up mesh, mm²: a rectangle plus, under each back edge, a parabola segment of 2/3 chord × sagitta (Archimedes).
pub(crate) fn area() -> f64 {
    let width = 4.0 * HALF_WIDTH;
    width * 0.3 + COLUMNS as f64 * (2.0 / 3.0) * (width / COLUMNS as f64) * SAGITTA
}

/// Two blocks that press on each other along a common straight side, placed as a gear pair would be.
///
/// Both are meshed in the fixed frame, with the side through the point (27, 0) and normal along 20° for the pinion, and then
/// turned back into their own frames.
pub(crate) fn frame(cycles: f64, position: f64) -> FieldFrame {
    let pressure_angle = 20f64.to_radians();
    // Moment arm of a force along this normal through (27, 0) about the origin.
    let torque_per_width = line_load() * 27.0 * pressure_angle.cos();
    FieldFrame {
        cycles,
        position,
        line_load: line_load(),
        torque_per_width,
        pinion: block(
            [0.0, 0.0],
            0.3 + 0.01 * position,
            std::f64::consts::FRAC_PI_2 - pressure_angle,
            cycles,
        ),
        gear: block(
            [80.0, 0.0],
            std::f64::consts::PI - 0.1,
            -std::f64::consts::FRAC_PI_2 - pressure_angle,
            cycles,
        ),
    }
}

/// One block; `outward` is the direction of its contact side's normal in the fixed frame.
fn block(centre: [f64; 2], rotation: f64, outward: f64, cycles: f64) -> MemberField {
    let (across, deep) = (2 * COLUMNS + 1, 2 * ROWS + 1);
    let node = |i: usize, j: usize| (j * across + i) as u32;
    let width = 4.0 * HALF_WIDTH;
    let normal = [outward.cos(), outward.sin()];
    let along = [normal[1], -normal[0]];
    let to_member = |[x, y]: [f64; 2]| {
        let (s, c) = (-rotation).sin_cos();
        [c * x - s * y, s * x + c * y]
    };
    let depth = if cycles > 0.0 { 1.5 } else { 0.0 };
    let mut field = MemberField {
        centre,
        rotation,
        reference: Vec::new(),
        worn: Vec::new(),
        cells: Cells::T6(Vec::new()),
        displacement: Vec::new(),
        stress: Vec::new(),
        von_mises: Vec::new(),
        contact_pressure: Vec::new(),
        contact_force: Vec::new(),
        wear_depth: Vec::new(),
    };
    for j in 0..deep {
        for i in 0..across {
            let s = width * (i as f64 / (across - 1) as f64 - 0.5);
            let below = 0.3 * j as f64 / (deep - 1) as f64;
            let bulge = if j == deep - 1 && i % 2 == 1 {
                SAGITTA
            } else {
                0.0
            };
            let t = below + bulge;
            let fixed = [
                27.0 + along[0] * s - normal[0] * t,
                along[1] * s - normal[1] * t,
            ];
            let worn = to_member([fixed[0] - centre[0], fixed[1] - centre[1]]);
            let out = to_member(normal);
            let lost = if j == 0 { depth * 1e-3 } else { 0.0 };
            field
                .reference
                .push([worn[0] + lost * out[0], worn[1] + lost * out[1]]);
            field.worn.push(worn);
            field.displacement.push([1e-3 * s, -2e-3 * t]);
            // Uniaxial tension 100 MPa along the member's own x axis, plane strain.
            field.stress.push([100.0, 0.0, 0.0, 30.0]);
            field
                .von_mises
                .push((100f64.powi(2) + 30f64.powi(2) - 100.0 * 30.0).sqrt());
            let pressure = if j == 0 {
                (PEAK * (1.0 - (s / HALF_WIDTH).powi(2))).max(0.0)
            } else {
                0.0
            };
            field.contact_pressure.push(pressure);
            field.contact_force.push([0.0, 0.0]);
            field.wear_depth.push(lost * 1e3);
        }
    }
    // Consistent forces of a quadratic edge of length L: ∫ N_a p = L/30 (4 p_a + 2 p_m − p_b), ∫ N_m p = L/15 (p_a + 8 p_m + p_b).
    let inward = to_member([-normal[0], -normal[1]]);
    let length = width / COLUMNS as f64;
    for edge in 0..COLUMNS {
        let [a, m, b] = [2 * edge, 2 * edge + 1, 2 * edge + 2];
        let p = |i: usize| field.contact_pressure[i];
        let forces = [
            length / 30.0 * (4.0 * p(a) + 2.0 * p(m) - p(b)),
            length / 15.0 * (p(a) + 8.0 * p(m) + p(b)),
            length / 30.0 * (4.0 * p(b) + 2.0 * p(m) - p(a)),
        ];
        for (i, force) in [a, m, b].into_iter().zip(forces) {
            field.contact_force[i][0] += force * inward[0];
            field.contact_force[i][1] += force * inward[1];
        }
    }
    let mut cells = Vec::new();
    for j in (0..deep - 1).step_by(2) {
        for i in (0..across - 1).step_by(2) {
            let n = |di: usize, dj: usize| node(i + di, j + dj);
            // With j running inwards and i along `along` these are counter-clockwise.
            cells.push([n(0, 0), n(0, 2), n(2, 2), n(0, 1), n(1, 2), n(1, 1)]);
            cells.push([n(0, 0), n(2, 2), n(2, 0), n(1, 1), n(2, 1), n(1, 0)]);
        }
    }
    let turned = |[a, b, c, ab, bc, ca]: [u32; 6]| [a, c, b, ca, bc, ab];
    if signed_area(&field, cells[0]) < 0.0 {
        cells = cells.into_iter().map(turned).collect();
    }
    field.cells = Cells::T6(cells);
    field
}

fn signed_area(field: &MemberField, cell: [u32; 6]) -> f64 {
    let [a, b, c] = [cell[0], cell[1], cell[2]].map(|n| field.worn[n as usize]);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
