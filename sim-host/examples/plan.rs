fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let sc = sim_host::scenario::Scenario::load(&args[0], &args[3..]).unwrap();
    let p = sim_host::plan::plan(&sc, args[1].parse().unwrap(), args[2].parse().unwrap(), |_| ()).unwrap();
    println!("# {} settle {:.3} flights {}", sc.name, p.settle_s, p.flights);
    println!("{}", toml::to_string(&p.plan).unwrap());
}
