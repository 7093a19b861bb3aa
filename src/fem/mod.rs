//! Floor 3: plane-strain linear elasticity: elements, assembly, sparse Cholesky, condensation onto the flanks, stresses.
