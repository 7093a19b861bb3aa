//! Floor 1: closed-form reference solutions, each with its own tests.
