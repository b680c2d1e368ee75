//! What chains tell of themselves, as text.

use super::output::count;
use crate::render::{Findings, MutationFindings};
use crate::systems::chains::ProposalCount;
use std::fmt::Write;

/// Lengths that have a column of their own.
const COLUMNS: usize = 7;

/// The findings as lines of text.
pub(super) fn text(findings: &Findings) -> String {
    let mut out = String::new();
    let interval = findings.normalization_interval;
    let interval = interval.map_or_else(String::new, |[low, high]| format!(" (95 %: {low:.5} to {high:.5})"));
    // Writing to a String cannot fail.
    let _ = writeln!(
        out,
        "b {:.5}{interval}; bootstraps of {} samples; {} chains in {} groups start from {} of them",
        findings.normalization,
        count(findings.bootstrap_samples as f64),
        findings.chains,
        findings.groups,
        findings.distinct_seeds
    );
    mutations(&mut out, &findings.mutations);
    let _ = write!(
        out,
        "longest run of rejections: {} steps (chain {})",
        findings.longest_rejections, findings.longest_rejections_chain
    );
    let steps: u64 = findings.mutations.iter().map(|mutation| mutation.count.proposed).sum();
    if let Some(samples) = findings.effective_samples {
        let [low, high] = samples.interval;
        let _ = write!(
            out,
            "; the {} states are worth {} independent ones (95 %: {} to {})",
            count(steps as f64),
            count(samples.total),
            count(low),
            count(high)
        );
    }
    out.push('\n');
    if let Some(worst) = findings
        .agreement
        .iter()
        .max_by(|a, b| a.agreement.ratio.total_cmp(&b.agreement.ratio))
    {
        let _ = writeln!(
            out,
            "groups agree to {:.2} of the variance expected or less in {} classes, worst in {} (R-hat {:.4})",
            worst.agreement.ratio,
            findings.agreement.len(),
            worst.class,
            worst.agreement.r_hat
        );
    }
    out
}

/// A table of acceptances, by mutation and by length of the path that was left.
fn mutations(out: &mut String, mutations: &[MutationFindings]) {
    let proposed: u64 = mutations.iter().map(|mutation| mutation.count.proposed).sum();
    let mut lengths: Vec<usize> = mutations
        .iter()
        .flat_map(|mutation| mutation.by_length.iter().map(|by| by.length))
        .collect();
    lengths.sort_unstable();
    lengths.dedup();
    lengths.truncate(COLUMNS);
    let _ = write!(
        out,
        "{:<16} {:>6} {:>6} {:>10}",
        "mutation", "tried", "taken", "impossible"
    );
    for length in &lengths {
        let _ = write!(out, " {:>6}", format!("k={length}"));
    }
    out.push_str(" longer\n");
    for mutation in mutations {
        let count = mutation.count;
        let _ = write!(
            out,
            "{:<16} {:>6} {:>6} {:>10}",
            mutation.name,
            percent(count.proposed, proposed),
            percent(count.accepted, count.proposed),
            percent(count.impossible, count.proposed)
        );
        let mut rest = ProposalCount::default();
        for by in &mutation.by_length {
            if !lengths.contains(&by.length) {
                rest = rest.plus(by.count);
            }
        }
        for length in &lengths {
            let at = mutation.by_length.iter().find(|by| by.length == *length);
            let at = at.map(|by| by.count).unwrap_or_default();
            let _ = write!(out, " {:>6}", percent(at.accepted, at.proposed));
        }
        let _ = writeln!(out, " {:>6}", percent(rest.accepted, rest.proposed));
    }
}

fn percent(part: u64, whole: u64) -> String {
    if whole == 0 {
        return "-".to_owned();
    }
    format!("{:.1} %", 100.0 * part as f64 / whole as f64)
}
