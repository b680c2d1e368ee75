//! The automaton of all layers together, as a table.

use super::expression::{end_byte, event_byte};
use super::layers::{End, LayerError};
use crate::material::Event;
use regex_automata::dfa::{Automaton, StartKind, dense};
use regex_automata::util::primitives::StateID;
use regex_automata::util::syntax;
use regex_automata::{Anchored, MatchKind};
use std::collections::HashMap;

/// Bytes that building the automaton may take: beyond it, an expression is too long or repeats too much.
const SIZE_LIMIT: usize = 16 << 20;

/// The transitions of the automaton of all patterns, and the first pattern, or `rest`, that matches paths which end in each state.
#[expect(clippy::type_complexity, reason = "two columns of one table")]
pub(super) fn table(patterns: &[String], rest: u8) -> Result<(Vec<[u16; 6]>, Vec<[u8; 3]>), LayerError> {
    if patterns.is_empty() {
        return Ok((vec![[0; 6]], vec![[rest; 3]]));
    }
    let config = dense::Config::new()
        .match_kind(MatchKind::All)
        .start_kind(StartKind::Anchored)
        .dfa_size_limit(Some(SIZE_LIMIT))
        .determinize_size_limit(Some(SIZE_LIMIT));
    let dfa = dense::Builder::new()
        .configure(config)
        .syntax(syntax::Config::new().unicode(false).utf8(false))
        .build_many(patterns)
        .map_err(|_| LayerError::TooComplicated)?;
    let start = dfa
        .universal_start_state(Anchored::Yes)
        .ok_or(LayerError::TooComplicated)?;
    let mut numbers: HashMap<StateID, u16> = HashMap::from([(start, 0)]);
    let (mut found, mut next, mut ends) = (vec![start], Vec::new(), Vec::new());
    while next.len() < found.len() {
        let state = found[next.len()];
        let mut row = [0; 6];
        for event in Event::ALL {
            let to = dfa.next_state(state, event_byte(event));
            let known = numbers.len();
            let number = u16::try_from(known).map_err(|_| LayerError::TooComplicated)?;
            row[event.number()] = *numbers.entry(to).or_insert(number);
            if numbers.len() > known {
                found.push(to);
            }
        }
        next.push(row);
        ends.push(End::ALL.map(|end| {
            let last = dfa.next_eoi_state(dfa.next_state(state, end_byte(end)));
            if !dfa.is_match_state(last) {
                return rest;
            }
            let matched = (0..dfa.match_len(last)).map(|i| dfa.match_pattern(last, i).as_usize());
            matched.min().map_or(rest, |pattern| pattern as u8)
        }));
    }
    Ok((next, ends))
}
