//! Plugins: the contract, programs of their own, and swapping.

mod commands;
mod contract;
mod examples;
mod swap;
mod walk;
