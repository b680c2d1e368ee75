//! Printing.

use miette::{IntoDiagnostic, Result, WrapErr};
use std::io::{ErrorKind, Write};

/// Prints a text and a line end to standard output. A reader that has gone away (`| head`) is no error.
pub fn print(text: &str) -> Result<()> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(error).into_diagnostic().wrap_err("cannot write to standard output")
        }
        _ => Ok(()),
    }
}

/// Prints a note to standard error; nobody can be told if that fails.
pub fn note(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Bytes for people: `1.5 MiB`.
pub fn bytes(count: u64) -> String {
    let units = ["B", "KiB", "MiB", "GiB", "TiB"];
    let mut value = count as f64;
    let mut unit = 0;
    while value >= 1024.0 && unit + 1 < units.len() {
        value /= 1024.0;
        unit += 1;
    }
    if unit == 0 {
        format!("{count} B")
    } else {
        format!("{value:.1} {}", units[unit])
    }
}

/// A count for people: `12.3 M`.
pub fn count(value: f64) -> String {
    match value {
        v if v >= 1e9 => format!("{:.2} G", v / 1e9),
        v if v >= 1e6 => format!("{:.2} M", v / 1e6),
        v if v >= 1e4 => format!("{:.1} k", v / 1e3),
        v => format!("{v:.0}"),
    }
}

/// A time for people, of two or three digits: `0.43 s`, `3 m 20 s`, `2 h 05 m`.
pub fn duration(seconds: f64) -> String {
    let whole = |unit: f64| (seconds / unit).round() as u64;
    match seconds {
        s if s < 0.095 => format!("{s:.3} s"),
        s if s < 9.95 => format!("{s:.2} s"),
        s if s < 59.5 => format!("{s:.0} s"),
        s if s < 3599.5 => format!("{} m {:02} s", whole(1.0) / 60, whole(1.0) % 60),
        s if s < 1.5 * 86400.0 => format!("{} h {:02} m", whole(60.0) / 60, whole(60.0) % 60),
        s if s < 1000.0 * 86400.0 => format!("{:.0} days", s / 86400.0),
        s if s.is_finite() => format!("{:.0} years", s / (365.25 * 86400.0)),
        _ => "no end".to_owned(),
    }
}

/// A ratio for people, of two or three digits.
pub fn significant(value: f64) -> String {
    match value {
        v if v < 0.095 => format!("{v:.3}"),
        v if v < 0.95 => format!("{v:.2}"),
        v if v < 9.95 => format!("{v:.1}"),
        v if v < 1e6 => format!("{v:.0}"),
        v => format!("{v:.0e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_read_well() {
        for (seconds, expected) in [
            (0.0123, "0.012 s"),
            (0.43, "0.43 s"),
            (9.96, "10 s"),
            (59.6, "1 m 00 s"),
            (200.4, "3 m 20 s"),
            (3599.7, "1 h 00 m"),
            (7500.0, "2 h 05 m"),
            (864_000.0, "10 days"),
            (1e12, "31688 years"),
            (f64::INFINITY, "no end"),
        ] {
            assert_eq!(duration(seconds), expected);
        }
        assert_eq!(
            [0.012, 0.43, 4.06, 42.3, 2.5e7].map(significant),
            ["0.012", "0.43", "4.1", "42", "2e7"]
        );
        assert_eq!(bytes(1023), "1023 B");
        assert_eq!(bytes(1536), "1.5 KiB");
        assert_eq!(bytes(u64::MAX), "16777216.0 TiB");
        assert_eq!(count(999.0), "999");
        assert_eq!(count(12_345_678.0), "12.35 M");
    }
}
