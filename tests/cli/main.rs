//! The program from outside: what is typed, what is found afterwards.

mod config;
mod demo;
mod home;
mod inspect;
mod outputs;
mod rectify;
mod robust;
mod settings;
mod several;
mod threads;
