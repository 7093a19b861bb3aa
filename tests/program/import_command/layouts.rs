//! Layouts of wide tables beyond a column for each checkpoint: several tables side by side, values with their standard deviations, statistics.

use super::*;

#[test]
fn tables_side_by_side_are_read_one_after_the_other() {
    let home = home();
    let table = "Run A\nRitzel;;;;Rad\nradius [mm];100000;250000;;radius [mm];100000;250000\n\
                 26;3.1;6.2;;52.5;1.1;2.2\n27;1.2;2.5;;53.5;0.4;0.9\n28;1.4;2.7\n";
    let (shown, written) = rows(&home, table, "--sigma 0.1");
    assert!(
        shown.contains("table.csv, columns A to C\n")
            && shown.contains("columns E to G, counted from A"),
        "{shown}"
    );
    assert_eq!(written.lines().count(), 10, "{written}");
    assert!(
        written.contains("A,pinion,250000,wear_depth,28,2.7,0.1,")
            && written.contains("A,gear,100000,wear_depth,52.5,1.1,0.1,"),
        "{written}"
    );
    let tests = "Pinion\nRun A;;;Run B\nradius [mm];100000;;radius [mm];250000\n26;3.1;;26;6.2\n27;1.2;;27;2.5\n";
    let (_, written) = rows(&home, tests, "--sigma 0.1");
    assert!(
        written.contains("A,pinion,100000,wear_depth,27,1.2,")
            && written.contains("B,pinion,250000,wear_depth,26,6.2,"),
        "{written}"
    );
}

/// A header over several columns belongs to each of them: the values of one test or member are never those of another.
#[test]
fn headers_over_several_columns_say_whose_they_are() {
    let home = home();
    let of_tests = "Raggio [mm];Usura pignone A [µm];;Usura pignone B [µm];\n;100000;250000;150000;300000\n\
                    26;3.1;6.2;4.1;7.2\n27;1.2;2.5;1.7;3.0\n28;1.3;2.6;1.8;3.1\n";
    let (shown, written) = rows(&home, of_tests, "--sigma 0.1");
    assert!(
        shown.contains("columns A and D to E, counted as A to C"),
        "{shown}"
    );
    assert_eq!(written.lines().count(), 12, "{written}");
    assert!(
        written.contains("A,pinion,250000,wear_depth,27,2.5,0.1,")
            && written.contains("B,pinion,300000,wear_depth,26,7.2,0.1,"),
        "{written}"
    );
    // the other test's columns are not the stated one's
    refused(&home, of_tests, "--sigma 0.1 --test A");
    // nor the gear's the pinion's, where they lie on its flank
    let of_members = "Radius [mm];Wear pinion [µm];;Wear gear [µm];\n;100000;250000;150000;300000\n\
                      52.5;3.1;6.2;4.1;7.2\n53;1.2;2.5;1.7;3.0\n53.5;1.3;2.6;1.8;3.1\n";
    refused(&home, of_members, "--sigma 0.1 --test A");
    // members over their values are the header itself
    let plain = "Mass loss [mg]\ncycles;pinion;gear\n100000;5;4\n200000;9;8\n";
    let (_, written) = rows(&home, plain, "--sigma 0.1 --test A");
    assert!(
        written.contains("A,gear,200000,mass_loss,,8,0.1,"),
        "{written}"
    );
    let masses = "Lastwechsel;A;;B;\n;Ritzel [mg];Rad [mg];Ritzel [mg];Rad [mg]\n100000;5;4;7;6\n200000;9;8;12;11\n";
    let (_, written) = rows(&home, masses, "--sigma 0.1 --quantity mass_loss");
    assert!(
        written.contains("A,gear,200000,mass_loss,,8,0.1,")
            && written.contains("B,pinion,100000,mass_loss,,7,0.1,"),
        "{written}"
    );
}

/// A loss beside the weighings it was taken from is that of one interval where each begins with the mass that the one before ended with.
#[test]
fn a_loss_beside_its_weighings_is_passed_over() {
    let home = home();
    let table = "Ensayo;Rueda;Vueltas;Peso inicial [g];Peso final [g];Pérdida [mg]\n\
                 A;piñón;100000;412,3512;412,3067;44,5\nA;piñón;200000;412,3067;412,2100;96,7\n";
    let (shown, written) = rows(&home, table, "--sigma 0.3");
    assert!(shown.contains("`Pérdida [mg]` passed over"), "{shown}");
    assert!(
        written.contains("A,pinion,100000,mass_loss,,44.5,0.3,")
            && written.contains("A,pinion,200000,mass_loss,,141.2,0.3,"),
        "{written}"
    );
    // of masses without a unit the loss is read, as it was stated
    let plain = table.replace(" [g]", "");
    let (_, written) = rows(&home, &plain, "--sigma 0.3");
    assert!(
        written.contains("A,pinion,100000,mass_loss,,44.5,0.3,"),
        "{written}"
    );
    let wrong = table.replace("96,7", "69,7");
    let message = refused(&home, &wrong, "--sigma 0.3");
    assert!(message.contains("F3: `Pérdida [mg]` says"), "{message}");
}

#[test]
fn weighings_side_by_side_and_new_parts_in_words() {
    let home = home();
    let weighings = "Versuch;Rad;Masse neu [g];Masse nach 40000 LW [g];Masse nach 100000 LW [g]\n\
                     A;Ritzel;612,4312;612,4097;612,3758\nA;Rad;1893,1177;1893,0954;1893,0640\n";
    let (_, written) = rows(&home, weighings, "--sigma 0.3");
    assert!(
        written.contains("A,pinion,40000,mass_loss,,21.5,0.3,")
            && written.contains("A,gear,100000,mass_loss,,53.7,0.3,"),
        "{written}"
    );
    let deviations = "Profilabweichung [µm]\nRadius [mm];neu;40 Tsd. LW;100 Tsd. LW\n26;0,5;-3;-9\n27;-0,5;-4;-9\n28;0,1;-2;-5\n";
    let (shown, written) = rows(&home, deviations, "--sigma 0.3 --test A --member pinion");
    assert!(shown.contains("`neu`: 0 cycles"), "{shown}");
    assert!(
        written.contains("A,pinion,40000,wear_depth,26,3.5,0.3,"),
        "{written}"
    );
    let chords = "Versuch;Rad;Umdrehungen;Messkreisdurchmesser [mm];Zahndickensehne neu [mm];Zahndickensehne verschlissen [mm]\n\
                  A;Ritzel;40000;54;3,1234;3,1218\n";
    let (_, written) = rows(&home, chords, "--sigma 0.3");
    assert!(
        written.contains("A,pinion,40000,chordal_loss,27,1.6,"),
        "{written}"
    );
    // by its unit `Giri` is a speed
    let speeds = "Prova;Elemento;Giri [rpm];Cicli;Perdita di massa [mg]\nA;pignone;2000;40000;21,5\nA;corona;2000;40000;22,5\n";
    let (shown, written) = rows(&home, speeds, "--sigma 0.3");
    assert!(shown.contains("`Giri [rpm]`"), "{shown}");
    assert!(
        written.contains("A,gear,40000,mass_loss,,22.5,"),
        "{written}"
    );
}

#[test]
fn standard_deviations_stand_behind_a_sign_or_beside_each_value() {
    let home = home();
    let options = "--member pinion --test A";
    let wide = "depth [um]\nradius [mm];100000;250000\n26;3,1 \u{b1} 0,2;6,2 \u{b1} 0,3\n27;1,2 \u{b1} 0,2;2,5\n28;1,3;2,6\n";
    let (shown, written) = rows(&home, wide, options);
    assert!(
        shown.contains("B3: `3,1 \u{b1} 0,2`, behind the sign: one standard deviation, in \u{b5}m"),
        "{shown}"
    );
    assert!(
        written.contains("A,pinion,250000,wear_depth,26,6.2,0.3,")
            && written.contains("A,pinion,250000,wear_depth,27,2.5,,"),
        "{written}"
    );
    let beside = "depth [mm]\nradius [mm];100000;\u{b1};250000;\u{b1}\n26;0.0031;0.0002;0.0062;0.0003\n27;0.0012;0.0002;0.0025;0.0003\n";
    let (_, written) = rows(&home, beside, options);
    assert!(
        written.contains("A,pinion,250000,wear_depth,26,6.2,0.3,"),
        "{written}"
    );
    // two standard deviations, in a unit of their own
    let expanded = beside
        .replace('\u{b1}', "U (k=2) [um]")
        .replace("0.0003", "0.6");
    let (shown, written) = rows(&home, &expanded, options);
    assert!(
        shown.contains("over k = 2") && written.contains(",26,6.2,0.3,"),
        "{shown}{written}"
    );
    let message = refused(&home, beside, &format!("{options} --sigma 0.1"));
    assert!(message.contains("C2: `\u{b1}`"), "{message}");
    let long = "cycles;radius [mm];depth [um]\n100000;26;3,1 +/- 0,2\n100000;27;1,2 +/- 0,2\n";
    let (_, written) = rows(&home, long, options);
    assert!(
        written.contains("A,pinion,100000,wear_depth,26,3.1,0.2,"),
        "{written}"
    );
}

#[test]
fn of_a_mean_and_extremes_the_mean_is_read() {
    let home = home();
    let options = "--member pinion --test A --sigma 0.1";
    let table = "radius [mm];100000 min;100000 max;100000 Mittel\n26;3;5;4\n27;1;3;2\n";
    let (shown, written) = rows(&home, table, options);
    assert!(shown.contains("the means are read"), "{shown}");
    assert!(
        written.starts_with("A,pinion,100000,wear_depth,26,4,0.1,"),
        "{written}"
    );
    assert_eq!(written.lines().count(), 2, "{written}");
    let message = refused(&home, &table.replace("Mittel", "median"), options);
    assert!(message.contains("not one mean"), "{message}");
}

#[test]
fn depths_in_millimetres_without_a_unit_say_which_option_reads_them() {
    let home = home();
    let row = |n: u32| {
        let depth = 0.004 + 0.0001 * f64::from(n % 3);
        format!(
            "{:.1};{depth:.4};{:.4}\n",
            26.0 + 0.1 * f64::from(n),
            2.0 * depth
        )
    };
    let table = format!(
        "radius [mm];100000;250000\n{}",
        (0..20).map(row).collect::<String>()
    );
    let message = refused(&home, &table, "--member pinion --test A");
    assert!(
        message.contains("this looks like mm") && message.contains("say it with --unit"),
        "{message}"
    );
}

#[test]
fn a_title_tells_what_was_measured_over_a_rotation() {
    let home = home();
    let table = "Errore di trasmissione [urad]\nRotazione [passi base];100000;250000\n0;105,7;161,9\n0,25;-10,2;-22,1\n0,5;-60,1;-70,3\n";
    let (_, written) = rows(&home, table, "--test A --sigma 0.5");
    assert!(
        written.contains("A,pair,250000,transmission_error,0.25,-22.1,0.5,"),
        "{written}"
    );
    let untitled = table.split_once('\n').unwrap().1;
    let message = refused(&home, untitled, "--test A --sigma 0.5");
    assert!(message.contains("--quantity"), "{message}");
}
