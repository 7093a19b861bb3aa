//! Tolerance: none, the files are compared byte by byte. The reference run of the other tests uses one thread.
use super::home::{FEM, Home};

#[test]
fn results_do_not_depend_on_threads() {
    let one = FEM.result("run").files();
    for threads in ["2", "3"] {
        let home = Home::with(&[]);
        home.succeed(&format!(
            "run study.toml -o run --threads {threads} --quiet"
        ));
        let many = home.result("run").files();
        assert_eq!(
            one.keys().collect::<Vec<_>>(),
            many.keys().collect::<Vec<_>>()
        );
        let fields = many.keys().filter(|name| name.ends_with(".vtu")).count();
        assert_eq!(fields, 3, "one drawn position of each of three states");
        for (name, bytes) in &many {
            // these two tell time and memory
            if name != "summary.json" && name != "report.html" {
                assert!(bytes == &one[name], "{name} differs with {threads} threads");
            }
        }
    }
}
