//! The processes of one program, kept from mesh to mesh.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use arrow_array::RecordBatch;
use seamline_ecs::{CommandSettings, StepError};

use crate::answer::{numbers, read_stream};
use crate::fault::Fault;
use crate::process::Process;

/// A program and those of its processes that have nothing to do.
pub struct Crew {
    settings: CommandSettings,
    idle: Mutex<Vec<Process>>,
}

impl Crew {
    /// A program that has not been started yet.
    pub fn new(settings: CommandSettings) -> Self {
        Self {
            settings,
            idle: Mutex::default(),
        }
    }

    /// How it is started, and what it is sent.
    pub fn settings(&self) -> &CommandSettings {
        &self.settings
    }

    /// Sends tables to a process of the program and waits for its answer: the numbers in a column of about so
    /// many rows. A process that did something wrong is ended.
    pub fn ask(
        &self,
        tables: &[RecordBatch],
        column: &'static str,
        rows: usize,
    ) -> Result<Vec<u32>, StepError> {
        let until = Instant::now() + Duration::from_secs_f64(self.settings.timeout_s);
        let answer = self.rested().map_or_else(
            || self.ask_new(tables, column, rows, until),
            |process| match self.ask_one(process, tables, column, rows, until) {
                // It ended after its last answer, just before it could be asked again.
                Err((Fault::Ended { .. }, true)) => self.ask_new(tables, column, rows, until),
                answer => answer.map_err(|(fault, _)| fault),
            },
        );
        answer.map_err(|fault| fault.of(&self.settings.command.join(" ")))
    }

    /// A process that has answered before and runs still.
    fn rested(&self) -> Option<Process> {
        let mut idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        while let Some(mut process) = idle.pop() {
            if process.is_at_rest() {
                return Some(process);
            }
        }
        None
    }

    fn ask_new(
        &self,
        tables: &[RecordBatch],
        column: &'static str,
        rows: usize,
        until: Instant,
    ) -> Result<Vec<u32>, Fault> {
        let process = Process::start(&self.settings)?;
        let answer = self.ask_one(process, tables, column, rows, until);
        answer.map_err(|(fault, _)| fault)
    }

    /// The answer, or the fault and whether the process had ended well without a word.
    fn ask_one(
        &self,
        mut process: Process,
        tables: &[RecordBatch],
        column: &'static str,
        rows: usize,
        until: Instant,
    ) -> Result<Vec<u32>, (Fault, bool)> {
        let exchange = |process: &mut Process| {
            process.send(tables.to_vec());
            let stream = read_stream(rows, |count| process.receive(count, until))?;
            process.finish_sending(until);
            numbers(stream, column)
        };
        match exchange(&mut process) {
            Ok(numbers) => {
                let mut idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner);
                idle.push(process);
                Ok(numbers)
            }
            Err(Fault::Silent(_)) => Err((Fault::Silent(self.settings.timeout_s), false)),
            Err(fault) => Err((fault, process.ended_well_without_a_word())),
        }
    }
}
