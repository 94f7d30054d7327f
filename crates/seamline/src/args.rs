//! What can be typed.

use std::path::PathBuf;

use clap::{Parser, Subcommand};

/// Cuts triangle meshes exported from CAD into the patches an engineer would draw.
///
/// Exit status: 0 all done; 1 some input failed, the others done; 2 wrong use or wrong configuration,
/// nothing done.
#[derive(Parser, Debug)]
#[command(version, max_term_width = 100)]
pub struct Args {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Subcommand, Debug)]
pub enum Command {
    /// Cut meshes into patches
    Segment(SegmentArgs),
    /// Close and clean the boundaries that another tool has found on a mesh
    Rectify(RectifyArgs),
    /// Watch folders and cut every mesh that is dropped there
    Watch(WatchArgs),
    /// Say what became of every file: pending, running, done, quarantined
    Status(StatusArgs),
    /// Have jobs done again, and bring back the files of those in quarantine
    Requeue(RequeueArgs),
    /// Say what a mesh is, and what is wrong with it
    Inspect(InspectArgs),
    /// List each swappable stage, what can fill it, and its settings; or check a plugin
    Plugins(PluginsArgs),
    /// Check a configuration, or print the schema of all configurations
    Config {
        #[command(subcommand)]
        command: ConfigCommand,
    },
}

#[derive(clap::Args, Debug)]
pub struct SegmentArgs {
    /// STL, OBJ or PLY files
    #[arg(required = true, value_name = "MESH")]
    pub meshes: Vec<PathBuf>,
    #[command(flatten)]
    pub results: ResultArgs,
    #[command(flatten)]
    pub pipeline: PipelineArgs,
    #[command(flatten)]
    pub said: SaidArgs,
}

#[derive(clap::Args, Debug)]
pub struct RectifyArgs {
    /// An STL, OBJ or PLY file
    #[arg(value_name = "MESH")]
    pub mesh: PathBuf,
    #[command(flatten)]
    pub what: WhatArgs,
    /// What tells the faces apart in a PLY (the name of a property, or colour) or an OBJ (group, object,
    /// material or smoothing) [default: the first that says more than one thing]
    #[arg(long, value_name = "NAME")]
    pub labels_by: Option<String>,
    /// Let boundaries run through triangles where they are smoother for it; triangles are cut for them
    #[arg(long)]
    pub refine: bool,
    #[command(flatten)]
    pub results: ResultArgs,
    #[command(flatten)]
    pub pipeline: PipelineArgs,
    #[command(flatten)]
    pub said: SaidArgs,
}

/// What there is to be rectified.
#[derive(clap::Args, Debug)]
#[group(required = true, multiple = false)]
pub struct WhatArgs {
    /// Labels of the faces: one a line (.seg), a PLY with a number or a colour a face, an OBJ with names, a
    /// .selection.txt. May be MESH itself
    #[arg(long, value_name = "F")]
    pub labels: Option<PathBuf>,
    /// Edges: two vertex numbers a line, from 0; lines of an OBJ; a .selection.txt. May be MESH itself
    #[arg(long, value_name = "F")]
    pub edges: Option<PathBuf>,
    /// Edges that turn by more degrees than this; as WEAK:STRONG, those above STRONG and those above WEAK that
    /// continue them
    #[arg(long, value_name = "ANGLE")]
    pub sharp_deg: Option<String>,
}

#[derive(clap::Args, Debug)]
pub struct ResultArgs {
    /// Folder the results go to: part.stl gives DIR/part.stl.seamline/
    #[arg(short, long, value_name = "DIR", default_value = ".")]
    pub output: PathBuf,
    /// Files to write, with commas, of labels,patches,boundaries,report; without it, all four
    #[arg(long, value_name = "LIST")]
    pub write: Option<String>,
    /// Print one report a line on standard output
    #[arg(long)]
    pub json: bool,
}

/// Settings of the pipeline. Each beats the environment (SEAMLINE_PROFILE, SEAMLINE_MERGE__THRESHOLD, ...),
/// which beats the file.
#[derive(clap::Args, Debug, Default)]
pub struct PipelineArgs {
    /// Set of defaults: cad or lavoue2005 [default: cad]
    #[arg(long, value_name = "NAME")]
    pub profile: Option<String>,
    /// Plugin that gives each curvature sample a cluster; see `seamline plugins`. A program of your own:
    /// '{ command = ["python3", "my_classifier.py"] }'
    #[arg(long, value_name = "NAME|COMMAND")]
    pub classifier: Option<String>,
    /// Plugin that cleans the boundaries, or none; or a program, as above
    #[arg(long, value_name = "NAME|COMMAND")]
    pub rectifier: Option<String>,
    /// Configuration whose pipeline part is used
    #[arg(long, value_name = "F.toml")]
    pub config: Option<PathBuf>,
    /// One setting by its dotted key, as merge.threshold=50; repeatable
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Threads used on one mesh; 0: all there are. Results do not depend on it
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
}

#[derive(clap::Args, Debug, Clone, Copy)]
pub struct SaidArgs {
    /// Say only what went wrong
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Say more
    #[arg(short, long)]
    pub verbose: bool,
}

#[derive(clap::Args, Debug)]
pub struct WatchArgs {
    /// The configuration; see watch-config/ for examples
    #[arg(value_name = "CONFIG.toml")]
    pub config: PathBuf,
    /// Cut what lies in the folders now, and end
    #[arg(long)]
    pub once: bool,
    /// Say what would be taken, and do none of it
    #[arg(long)]
    pub dry_run: bool,
    #[command(flatten)]
    pub said: SaidArgs,
}

#[derive(clap::Args, Debug)]
pub struct StatusArgs {
    /// The configuration of the daemon, which may run meanwhile
    #[arg(value_name = "CONFIG.toml")]
    pub config: PathBuf,
    /// Every job, as JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(clap::Args, Debug)]
pub struct RequeueArgs {
    /// The configuration of the daemon, which may run meanwhile
    #[arg(value_name = "CONFIG.toml")]
    pub config: PathBuf,
    /// Numbers of jobs, as `seamline status` tells them
    #[arg(value_name = "JOB", required_unless_present = "all_quarantined")]
    pub jobs: Vec<i64>,
    /// All jobs in quarantine
    #[arg(long, conflicts_with = "jobs")]
    pub all_quarantined: bool,
}

#[derive(clap::Args, Debug)]
pub struct InspectArgs {
    /// STL, OBJ or PLY files
    #[arg(required = true, value_name = "MESH")]
    pub meshes: Vec<PathBuf>,
    /// One line of JSON a mesh
    #[arg(long)]
    pub json: bool,
}

#[derive(clap::Args, Debug)]
#[command(args_conflicts_with_subcommands = true)]
pub struct PluginsArgs {
    /// As JSON
    #[arg(long)]
    pub json: bool,
    #[command(subcommand)]
    pub command: Option<PluginsCommand>,
}

#[derive(Subcommand, Debug)]
pub enum PluginsCommand {
    /// Put a plugin, or a program of your own, to the test of the contract, and say what it breaks
    Check(CheckPluginArgs),
}

#[derive(clap::Args, Debug)]
pub struct CheckPluginArgs {
    /// The stage a program fills: classify or rectify [default: classify; of a plugin, its own]
    #[arg(long, value_name = "STAGE")]
    pub stage: Option<String>,
    /// The longest a program may take over one mesh, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0)]
    pub timeout_s: f64,
    /// The tables a program is sent, with commas; all of its stage where none is named
    #[arg(long, value_name = "TABLES", value_delimiter = ',')]
    pub send: Vec<String>,
    /// The name of a plugin, or a program with its arguments; one word without `/` is a name
    #[arg(
        required = true,
        value_name = "NAME|COMMAND",
        trailing_var_arg = true,
        allow_hyphen_values = true
    )]
    pub what: Vec<String>,
}

#[derive(Subcommand, Debug)]
pub enum ConfigCommand {
    /// Check a configuration without starting anything
    Check {
        /// The configuration
        #[arg(value_name = "CONFIG.toml")]
        config: PathBuf,
    },
    /// Print the JSON schema of configurations
    Schema,
}
