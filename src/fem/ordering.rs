//! Elimination order of the nodes: little fill inside, the interface last.
//!
//! Minimum degree is run on the graph of nodes, not of unknowns (a node's two unknowns have the same neighbours, so they
//! stay together); the interior is then put into postorder of its elimination tree, which makes the columns of equal
//! structure adjacent, as supernodes need.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::simplicial;

use super::FemError;
use super::triangle::{element_count, nodes_of};
use crate::mesh::Cells;

/// The nodes for which `keep` holds, in elimination order, `interface` (a subset) last and in the order given.
pub(super) fn elimination_order(
    cells: &Cells,
    keep: &[bool],
    interface: &[u32],
) -> Result<Vec<u32>, FemError> {
    let mut local = vec![u32::MAX; keep.len()];
    let mut is_interface = vec![false; keep.len()];
    for &node in interface {
        is_interface[node as usize] = true;
    }
    let interior: Vec<u32> = (0..keep.len() as u32)
        .filter(|&n| keep[n as usize] && !is_interface[n as usize])
        .collect();
    for (place, &node) in interior.iter().enumerate() {
        local[node as usize] = place as u32;
    }
    let graph = upper_graph(cells, &local, interior.len());
    let too_large = |_| FemError::TooLarge {
        unknowns: 2 * keep.len(),
    };

    let n = interior.len();
    let (mut forward, mut inverse) = (vec![0u32; n], vec![0u32; n]);
    let pattern = SymbolicSparseColMatRef::new_checked(n, n, &graph.start, None, &graph.row);
    let mut memory =
        MemBuffer::try_new(amd::order_scratch::<u32>(n, graph.row.len())).map_err(too_large)?;
    amd::order(
        &mut forward,
        &mut inverse,
        pattern,
        amd::Control::default(),
        MemStack::new(&mut memory),
    )
    .map_err(|_| FemError::TooLarge {
        unknowns: 2 * keep.len(),
    })?;

    for (place, &old) in forward.iter().enumerate() {
        local[interior[old as usize] as usize] = place as u32;
    }
    let graph = upper_graph(cells, &local, n);
    let pattern = SymbolicSparseColMatRef::new_checked(n, n, &graph.start, None, &graph.row);
    let (mut parent, mut counts) = (vec![0i32; n], vec![0u32; n]);
    let request = simplicial::prefactorize_symbolic_cholesky_scratch::<u32>(n, graph.row.len());
    let mut memory = MemBuffer::try_new(request).map_err(too_large)?;
    simplicial::prefactorize_symbolic_cholesky(
        &mut parent,
        &mut counts,
        pattern,
        MemStack::new(&mut memory),
    );

    let mut order: Vec<u32> = postorder(&parent)
        .into_iter()
        .map(|place| interior[forward[place as usize] as usize])
        .collect();
    order.extend(interface.iter().filter(|&&node| keep[node as usize]));
    Ok(order)
}

/// Upper triangle of the node graph in compressed columns.
struct Graph {
    start: Vec<u32>,
    row: Vec<u32>,
}

/// The graph of the nodes that have a `local` number below `n`; two nodes are neighbours if they share a triangle.
fn upper_graph(cells: &Cells, local: &[u32], n: usize) -> Graph {
    let mut columns: Vec<Vec<u32>> = vec![Vec::new(); n];
    for index in 0..element_count(cells) {
        let (len, nodes) = nodes_of(cells, index);
        for &a in &nodes[..len] {
            for &b in &nodes[..len] {
                let (i, j) = (local[a as usize], local[b as usize]);
                if j != u32::MAX && i <= j {
                    columns[j as usize].push(i);
                }
            }
        }
    }
    let mut start = vec![0u32; n + 1];
    for (j, list) in columns.iter_mut().enumerate() {
        list.sort_unstable();
        list.dedup();
        start[j + 1] = start[j] + list.len() as u32;
    }
    Graph {
        start,
        row: columns.concat(),
    }
}

/// Nodes of a forest, every node after all its children; `parent` is negative at a root.
fn postorder(parent: &[i32]) -> Vec<u32> {
    let n = parent.len();
    let (mut first_child, mut next_sibling) = (vec![u32::MAX; n], vec![u32::MAX; n]);
    let mut roots = Vec::new();
    for node in (0..n).rev() {
        match usize::try_from(parent[node]) {
            Ok(p) => {
                next_sibling[node] = first_child[p];
                first_child[p] = node as u32;
            }
            Err(_) => roots.push(node as u32),
        }
    }
    let mut order = Vec::with_capacity(n);
    let mut stack = Vec::new();
    for &root in roots.iter().rev() {
        stack.push(root);
        while let Some(&top) = stack.last() {
            let child = first_child[top as usize];
            if child == u32::MAX {
                order.push(top);
                stack.pop();
            } else {
                first_child[top as usize] = next_sibling[child as usize];
                stack.push(child);
            }
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_node_comes_once_and_after_its_whole_subtree() {
        let parent = [4, 3, 3, 5, 5, -1, -1];
        let order = postorder(&parent);
        assert_eq!(order, vec![1, 2, 3, 0, 4, 5, 6]);
    }
}
