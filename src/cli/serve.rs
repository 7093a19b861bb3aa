//! `gearwear serve`: the study's model and its probability for samplers and other programs, by UM-Bridge over HTTP.

use std::net::{IpAddr, SocketAddr, TcpListener};
use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::{CliError, Context, Outcome};
use crate::learn::{Measured, ModelVersion, Simulator, contact_of};
use crate::serve::{Limits, Models, answer, serve};
use crate::study::Study;

/// Arguments of `serve`.
#[derive(Debug, Args)]
#[command(
    after_help = "Models: standardised (rows; 0 is the study's value, 1 a standard deviation of the prior away), forward (rows; parameters in their units), log_likelihood and log_posterior. The arguments are the parameters that [fit] free names, in that order. Gradients are exact.\nThere is no password: whoever reaches the port can ask. SIGTERM or Ctrl-C ends the server, exit code 0.\n\nExamples:\n  gearwear serve study.toml\n  gearwear serve study.toml --port 8000\n  PORT=8000 gearwear serve study.toml --quiet\n  curl -d '{\"name\": \"standardised\", \"input\": [[0.0]]}' http://localhost:4242/Evaluate"
)]
pub struct ServeArgs {
    /// Study file (TOML) with tests and measurements
    #[arg(value_name = "STUDY")]
    study: PathBuf,
    /// Port to listen at; 0 takes any that is free [default: the environment's PORT, or 4242]
    #[arg(long, value_name = "N")]
    port: Option<u16>,
    /// Address to listen at; 0.0.0.0 is reached from other machines
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1")]
    host: IpAddr,
}

/// The port where nothing else is said: that of the protocol.
const PORT: u16 = 4242;

/// Checks the study, opens the port, prepares the gears, answers until it is asked to end.
pub(super) fn execute(args: &ServeArgs, context: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.study)?;
    let kind = contact_of(&study)?;
    let data = study.dataset_to_fit()?;
    context.tell_reading(&data);
    let version = ModelVersion::of(&study);
    if version.free.is_empty() {
        return Err(CliError::Unusable(format!(
            "{}: nothing is free, so there is nothing to ask; name parameters in [fit] free",
            args.study.display()
        )));
    }
    let port = match args.port {
        Some(port) => port,
        None => port_of_environment()?,
    };
    let address = SocketAddr::new(args.host, port);
    let taken = |source: std::io::Error| {
        CliError::Unusable(format!(
            "cannot listen at {address}: {source}; name another port with --port, or end what listens there"
        ))
    };
    let listener = TcpListener::bind(address).map_err(taken)?;
    let address = listener.local_addr().map_err(taken)?;
    let progress = context.progress("serve");
    progress.stage("mesh, factor and condense both gears");
    let measured = Measured::new(&study, data);
    let workshop = measured.workshop(kind)?;
    progress.stage_at(0.5, "prepare the tests");
    let bench = measured.finest_bench(&workshop)?;
    drop(progress);
    let simulator = Simulator::new(&measured, &bench, &version);
    let models = Models::new(&simulator);
    let names = models.names();
    let url = format!("http://{address}");
    let scatter = names.get(1).map_or(String::new(), |names| {
        format!(
            "\n  log_likelihood and log_posterior take a second list: {}",
            names.join(", ")
        )
    });
    context.tell(&format!(
        "listening at {url} (UM-Bridge 1.0): {}\n  arguments: {}{scatter}",
        names_of_models().join(", "),
        names[0].join(", "),
    ));
    let limits = Limits {
        computing: rayon::current_num_threads(),
        ..Limits::default()
    };
    serve(listener, limits, &|method, path, body| {
        answer(&models, method, path, body)
    })
    .map_err(|source| CliError::Serve { source })?;
    Ok(Outcome {
        json: json!({"url": url, "models": names_of_models(), "inputs": names}),
        text: format!("{url} has ended\n"),
        success: true,
    })
}

fn names_of_models() -> Vec<&'static str> {
    crate::serve::models::Kind::ALL
        .map(crate::serve::models::Kind::name)
        .to_vec()
}

/// What job scripts set.
fn port_of_environment() -> Result<u16, CliError> {
    match std::env::var("PORT") {
        Err(_) => Ok(PORT),
        Ok(text) => text.trim().parse().map_err(|_| {
            CliError::Unusable(format!(
                "the environment's PORT is {text:?}, allowed: 0 to 65535; unset it or name a port with --port"
            ))
        }),
    }
}
