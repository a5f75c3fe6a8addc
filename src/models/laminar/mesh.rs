//! Nodes from 0 to 1, with one on every level where the solution has a corner.

use crate::numerics::levels::graded;

/// Nodes of the mesh, ascending; the first and the last are the walls.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    nodes: Vec<f64>,
}

/// A layer of the mesh: its top, its share of the elements, and the size of the smallest one at its ends.
#[derive(Clone, Copy, Debug)]
pub struct Layer {
    /// upper end
    pub top: f64,
    /// number of elements
    pub elements: usize,
    /// size of the element at the lower end; infinite: equal elements
    pub finest_below: f64,
    /// size of the element at the upper end; infinite: equal elements
    pub finest_above: f64,
}

impl Mesh {
    /// Layers from 0 upwards; layers without thickness or elements are left out.
    #[must_use]
    pub fn layered(layers: &[Layer]) -> Self {
        let mut nodes = vec![0.0];
        for layer in layers {
            let bottom = nodes.last().copied().unwrap_or(0.0);
            if layer.top <= bottom || layer.elements == 0 {
                continue;
            }
            let (below, above) = (layer.finest_below, layer.finest_above);
            if below.is_finite() && above.is_finite() && layer.elements > 1 {
                let (lower, middle) = (layer.elements / 2, 0.5 * (bottom + layer.top));
                let mirrored = graded(bottom, middle, lower, below);
                nodes.extend(mirrored.iter().rev().skip(1).map(|z| bottom + middle - z));
                nodes.extend(graded(middle, layer.top, layer.elements - lower, above).into_iter().skip(1));
            } else {
                nodes.extend(graded(bottom, layer.top, layer.elements, above).into_iter().skip(1));
            }
        }
        Self { nodes }
    }

    /// Elevations of the nodes.
    #[must_use]
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Number of elements.
    #[must_use]
    pub fn elements(&self) -> usize {
        self.nodes.len() - 1
    }

    /// Thickness of element `k`.
    #[must_use]
    pub fn size(&self, k: usize) -> f64 {
        self.nodes[k + 1] - self.nodes[k]
    }

    /// Middle of element `k`.
    #[must_use]
    pub fn middle(&self, k: usize) -> f64 {
        0.5 * (self.nodes[k] + self.nodes[k + 1])
    }

    /// Number of elements below the level `z`, on which there is a node.
    #[must_use]
    pub fn below(&self, z: f64) -> usize {
        (0..self.elements()).take_while(|&k| self.middle(k) < z).count()
    }
}
