//! The page of a comparison: the answer, the first figure, what to bear in mind, the numbers, the other figures and the origin.

use super::{Comparison, Deviation, Kind, NormRow, NumberRow};
use crate::plot::{Cell, Document, Section, document_html};
use crate::result::Figure;
use crate::result::Verdict;
use crate::result::quantity::{self, Quantity};
use crate::result::{Cost, Provenance};
use crate::units::{CommonUnits, readable, significant};

impl Comparison {
    /// The page with `figures`, which are those of [`Comparison::figures`].
    #[must_use]
    pub fn html(&self, figures: &[Figure], cost: &Cost, provenance: &Provenance) -> String {
        let names: Vec<&str> = self.subjects.iter().map(|s| s.name.as_str()).collect();
        let (reference, others) = names.split_first().map_or(("", &[][..]), |(first, rest)| (*first, rest));
        let title = format!("{reference} against {}", others.join(", "));
        let units = if self.scaled { "divided by each one's scales" } else { "in SI units" };
        let (first, others) = figures.split_at(figures.len().min(1));
        let sections = [
            Section::Answer(self.answer()),
            Section::Figures(first),
            Section::Warnings(self.warnings()),
            self.numbers_section(),
            self.norms_section(),
            self.inputs_section(),
            self.subjects_section(),
            Section::Figures(others),
            origin(cost, provenance),
        ];
        let subtitle = format!("The reference is {reference}; {}, {units}.", self.align.datum());
        document_html(&Document { title: &title, subtitle: &subtitle, sections: &sections })
    }

    /// What a reader must know to take the numbers for what they are.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let mut found: Vec<String> = Vec::new();
        for (verdict, word) in [(Verdict::Broken, "broken"), (Verdict::Doubtful, "doubtful")] {
            for subject in &self.subjects {
                let of = subject.regime.iter().filter(|premise| premise.verdict == verdict);
                found.extend(of.map(|premise| format!("A premise of {} is {word}: {}.", subject.name, premise.line())));
            }
        }
        let beds: Vec<f64> = self.views.iter().filter_map(|v| v.bed).collect();
        let (low, high) = beds.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &z| (a.min(z), b.max(z)));
        // levels as they are read off a figure do not agree to more than about a hundredth
        if high - low > 1e-2 * high.abs().max(low.abs()) {
            let (low, high) = (self.value(low, &quantity::Z), self.value(high, &quantity::Z));
            found.push(format!("The bed levels lie between {low} and {high}: --align bed puts them on each other."));
        }
        found.extend(self.amounts());
        for row in self.norms.iter().filter(|n| n.deviation.is_none()) {
            let name = self.name(row.subject);
            found.push(format!("{} of {name} is defined at no elevation where the reference is.", row.quantity.title));
        }
        let mut outside: Vec<(String, Vec<&str>)> = Vec::new();
        for subject in &self.subjects {
            for v in &subject.validity {
                let text = format!("{}: {} = {} ({})", v.closure, v.variable, significant(v.value, 3), v.range);
                match outside.iter_mut().find(|(known, _)| *known == text) {
                    Some((_, names)) => names.push(&subject.name),
                    None => outside.push((text, vec![&subject.name])),
                }
            }
        }
        found.extend(
            outside.into_iter().map(|(law, names)| format!("Outside its range in {}: {law}.", names.join(", "))),
        );
        found
    }

    /// A value in the units of the comparison, for readers: `3.310 mm/s`, `0.4500 Uₘ`.
    #[must_use]
    pub fn value(&self, value: f64, quantity: &'static Quantity) -> String {
        match self.unit(quantity) {
            _ if !self.scaled => readable(value, quantity.unit),
            "1" => significant(value, 4),
            unit => format!("{} {unit}", significant(value, 4)),
        }
    }

    fn name(&self, subject: usize) -> &str {
        self.subjects.get(subject).map_or("", |s| s.name.as_str())
    }

    fn subjects_section(&self) -> Section<'static> {
        let mut head: Vec<String> =
            ["name", "what it is", "source", "levels", "solid volume per area"].map(str::to_owned).to_vec();
        let shifted = self.views.iter().any(|v| v.shift_m != 0.0);
        if shifted {
            head.push("moved down by".into());
        }
        if self.scaled {
            head.extend(["H", "Uₘ", "τ(hₚ)"].map(str::to_owned));
        }
        let rows = self.subjects.iter().zip(&self.views).map(|(subject, view)| {
            let kind = match subject.kind {
                Kind::Case => "case",
                Kind::Run => "run",
                Kind::Data => "data",
            };
            let notes: String = subject.notes.iter().map(|n| format!("; {n}")).collect();
            let mut row = vec![
                Cell::Text(subject.name.clone()),
                Cell::Text(format!("{kind}: {}{notes}", subject.label)),
                Cell::Text(subject.source.clone()),
                number(subject.profile.rows().to_string(), subject.profile.rows() as f64),
                subject.solid_volume().map_or(Cell::Empty("unknown"), |v| number(readable(v, "m"), v)),
            ];
            if shifted {
                row.push(number(readable(view.shift_m, "m"), view.shift_m));
            }
            if let Some(scales) = view.scales {
                let scale = |x: Option<f64>, unit| x.map_or(Cell::Empty("unknown"), |x| number(readable(x, unit), x));
                row.push(scale(Some(scales.length_m), "m"));
                row.push(scale(scales.velocity_m_s, "m/s"));
                row.push(scale(scales.stress_pa, "Pa"));
            }
            row
        });
        Section::Table { heading: "Compared", lead: String::new(), rows: rows.collect(), head }
    }

    fn norms_section(&self) -> Section<'static> {
        let with_sigmas = self.norms.iter().any(|n| n.sigmas.is_some());
        let mut head: Vec<String> =
            ["against the reference", "column", "levels", "L² relative", "largest", "at z", "bias"]
                .map(str::to_owned)
                .to_vec();
        if with_sigmas {
            head.push("RMS in σ".into());
        }
        let rows = self.norms.iter().map(|row| {
            let mut cells = vec![Cell::Text(self.name(row.subject).into()), Cell::Text(row.quantity.title.into())];
            match &row.deviation {
                Some(d) => cells.extend(self.norm_cells(row, d)),
                None => cells.extend(std::iter::repeat_n(Cell::Empty("no common elevation"), 5)),
            }
            if with_sigmas {
                cells.push(row.sigmas.map_or(Cell::Empty("no errors are given"), |s| {
                    let full = format!("{:?} over {} levels", s.rms, s.levels);
                    Cell::Number { shown: significant(s.rms, 3), full }
                }));
            }
            cells
        });
        let lead = "Deviations at the levels of the coarser of the two, the finer interpolated linearly; sums weighted by height. \
                    L² is relative to the reference.";
        Section::Table { heading: "Profiles", lead: lead.into(), rows: rows.collect(), head }
    }

    fn norm_cells(&self, row: &NormRow, d: &Deviation) -> [Cell; 5] {
        let value = |x: f64, quantity| number(self.value(x, quantity), x);
        let of = self.coarser(row, d.coarser).unwrap_or_default();
        let levels = Cell::Number { shown: d.levels.to_string(), full: format!("of {of}") };
        let l2 = d.l2_relative.map_or(Cell::Empty("the reference is zero"), |x| number(percent(x), x));
        [levels, l2, value(d.linf, row.quantity), value(d.linf_at, &quantity::Z), value(d.bias, row.quantity)]
    }

    fn numbers_section(&self) -> Section<'static> {
        let mut head = vec!["number".to_owned()];
        for (i, subject) in self.subjects.iter().enumerate() {
            head.push(subject.name.clone());
            if i > 0 {
                head.push("difference".into());
            }
        }
        let each = |row: &NumberRow| {
            let values: Vec<f64> = row.values.iter().flatten().map(|(value, _)| *value).collect();
            values.into_iter().map(|value| (value, row.quantity.unit)).collect::<Vec<_>>()
        };
        let units = CommonUnits::of(self.numbers.iter().flat_map(each));
        let shown = |value: f64, quantity: &'static Quantity| match self.scaled {
            true => self.value(value, quantity),
            false => units.readable(value, quantity.unit),
        };
        let rows = self.numbers.iter().map(|row| {
            let mut cells = vec![Cell::Text(row.quantity.title.into())];
            for (i, (value, difference)) in row.values.iter().zip(&row.differences).enumerate() {
                cells.push(value.map_or(Cell::Empty("not reported"), |(value, error)| {
                    let sigma = error.map_or_else(String::new, |e| format!(" ± {}", shown(e, row.quantity)));
                    let full = format!("{} = {value:?}", row.quantity.name);
                    Cell::Number { shown: shown(value, row.quantity) + &sigma, full }
                }));
                if i > 0 {
                    let base = i == row.base || value.is_none();
                    let known = difference.filter(|_| !base);
                    cells.push(known.map_or(Cell::Empty("nothing to relate it to"), |x| number(percent(x), x)));
                }
            }
            cells
        });
        let lead = "Differences relative to the reference, or to the first that reports the number.";
        Section::Table { heading: "Numbers", lead: lead.into(), rows: rows.collect(), head }
    }
}

/// What several runs cost together, and where they come from.
#[must_use]
pub fn origin(cost: &Cost, provenance: &Provenance) -> Section<'static> {
    let memory = cost.peak_memory_mb.map_or_else(String::new, |mb| format!("{mb:.0} MB"));
    let costs = [
        ("solvers", format!("{:.2} ms", 1e3 * cost.solve_s)),
        ("everything", format!("{:.1} ms", 1e3 * cost.total_s)),
        ("peak memory", memory),
    ];
    let facts = [
        ("bedload", format!("{} ({})", provenance.bedload, provenance.commit)),
        ("compiler", provenance.rustc.clone()),
        ("target", provenance.target.clone()),
        ("command", provenance.source.clone()),
        ("started", provenance.started_utc.clone()),
    ];
    let owned = |rows: &[(&str, String)]| rows.iter().map(|(k, v)| ((*k).to_owned(), v.clone())).collect();
    Section::Facts(vec![("Cost", owned(&costs)), ("Provenance", owned(&facts))])
}

fn number(shown: String, full: f64) -> Cell {
    Cell::Number { shown, full: format!("{full:?}") }
}

/// A share in per cent: `3.20 %`.
#[must_use]
pub fn percent(share: f64) -> String {
    format!("{} %", significant(100.0 * share, 3))
}
