//! Posterior densities with gradients, for samplers outside.

pub(super) mod posterior;
pub(super) mod simulator;
