//! What `bedload` promises, tested from outside: the program as a person runs it, and the library as a study calls it.
//! One binary, so that it links once.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod advise;
mod architecture;
mod calibrate;
mod cases_bad;
mod cases_good;
mod chart;
mod circles;
mod cli;
mod compare;
mod converge;
mod cost;
mod coupled;
mod docs;
mod features;
mod folder;
mod full_disk;
mod goldens;
mod grains;
mod interruption;
mod kinetic;
mod laws;
mod limits;
mod lock;
mod mutate;
mod never_panics;
mod no_bed;
mod own_law;
mod own_model;
mod page;
mod paths;
mod places;
mod premises;
mod private;
mod report;
mod scenes;
mod schema;
mod sheet;
mod sheet_statements;
mod studies;
mod support;
mod sweep;
mod uphill;
