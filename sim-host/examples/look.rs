use sim_host::{flight, record::Row, scenario::Scenario};
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let sc = Scenario::load(&args[0], &args[1..]).unwrap();
    let mut rows: Vec<Row> = Vec::new();
    let t0 = std::time::Instant::now();
    let out = flight::fly(&sc, 1, &mut rows).unwrap();
    let dt = t0.elapsed().as_secs_f64();
    print!("{:22} surv={} sat={} rtf={:.0} ", sc.name, out.survived, out.saturated_ticks, rows.len() as f64 * 1e-3 / dt);
    for i in 0..3 {
        let e = |r: &Row| r.reference[i] - r.position[i];
        let settle = |tol: f64| rows.iter().rposition(|r| e(r).abs() >= tol).map_or(0.0, |k| (k + 1) as f64 * 1e-3);
        let late: Vec<f64> = rows.iter().filter(|r| r.t >= 4.0).map(e).collect();
        let rms = (late.iter().map(|v| v * v).sum::<f64>() / late.len() as f64).sqrt();
        let max = late.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        print!("| {} 5cm {:.3} 2mm {:.3} rms {:.5} max {:.5}mm ", ["x","y","z"][i], settle(0.05), settle(0.002), rms*1e3, max*1e3);
    }
    println!();
    if std::env::var("ROWS").is_ok() { for r in rows.iter().step_by(50).take(60) { println!("{:.2} p {:.3?} q {:.3?} w {:.2?} ref {:.3?} u {:.3?} s {:.3?} om {:.1?}", r.t, r.position, r.attitude, r.rates, r.reference, r.u, r.s, r.omega); } }
}
