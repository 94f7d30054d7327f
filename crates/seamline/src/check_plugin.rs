//! `seamline plugins check`: does a plugin keep the contract?

use std::panic;

use anyhow::Result;
use seamline_ecs::contract::check;
use seamline_ecs::{CommandSettings, PluginChoice, Registry, SwappableStage};
use seamline_segment::builtin_steps;

use crate::args::CheckPluginArgs;
use crate::outcome::{Outcome, WrongUse};
use crate::say::{counted, print, tell_as_it_comes};

/// Tests a plugin and tells what it breaks; one that breaks something counts as input that failed.
pub fn run(args: &CheckPluginArgs) -> Result<Outcome> {
    let registry = seamline_plugins::registry();
    let (stage, choice) = choice(args, &registry)?;
    tell_as_it_comes();
    // A panic is told as what it is: something the plugin breaks.
    panic::set_hook(Box::new(|_| {}));
    let trials = check(&builtin_steps(), &registry, stage, &choice)?;
    let _ = panic::take_hook();

    let mut broken = 0;
    for trial in &trials {
        let seconds = trial.took.as_secs_f64();
        if trial.breaks.is_empty() {
            print(&format_args!("ok      {:<44} {seconds:>7.3} s", trial.of))?;
        }
        for what in &trial.breaks {
            broken += 1;
            print(&format_args!("BREAKS  {}: {what}", trial.of))?;
        }
    }
    print(&if broken == 0 {
        "keeps the contract".to_owned()
    } else {
        format!(
            "breaks the contract in {}",
            counted(broken, "place", "places")
        )
    })?;
    Ok(Outcome::of_failures(broken))
}

fn choice(args: &CheckPluginArgs, registry: &Registry) -> Result<(SwappableStage, PluginChoice)> {
    if let [name] = &args.what[..]
        && !name.contains('/')
    {
        let entries = registry.entries().iter();
        let stage = entries
            .filter(|entry| entry.name == name)
            .map(|entry| entry.stage)
            .next();
        let asked = args.stage.as_deref().map(stage_named).transpose()?;
        if let (Some(stage), Some(asked)) = (stage, asked)
            && stage != asked
        {
            let (stage, asked) = (stage.stage().name(), asked.stage().name());
            return Err(WrongUse(format!(
                "--stage {asked}: {name} fills {stage}; name --stage {stage}, or none"
            ))
            .into());
        }
        let stage = stage.or(asked).unwrap_or(SwappableStage::Classify);
        return Ok((stage, PluginChoice::Named(name.clone())));
    }
    let command = CommandSettings {
        timeout_s: args.timeout_s,
        send: args.send.clone(),
        ..CommandSettings::new(args.what.clone())
    };
    let stage = args.stage.as_deref().map(stage_named).transpose()?;
    let stage = stage.unwrap_or(SwappableStage::Classify);
    Ok((stage, PluginChoice::Command(command)))
}

fn stage_named(name: &str) -> Result<SwappableStage, WrongUse> {
    let found = SwappableStage::ALL
        .into_iter()
        .find(|stage| stage.stage().name() == name);
    found.ok_or_else(|| WrongUse(format!("--stage {name}: is none; name classify or rectify")))
}
