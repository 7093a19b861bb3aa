//! Floor 4: contact between two flanks: mortar coupling, unilateral contact, load sharing.
