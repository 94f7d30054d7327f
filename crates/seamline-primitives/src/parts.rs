//! Parts: the pieces of a mesh in groups, each a surface accepted, a plane, or a free form.

use std::collections::BTreeMap;

use seamline_mesh::Sets;

use crate::certain::is_certain_plane;
use crate::hypothesis::View;
use crate::pieces::NONE;
use crate::regions::{Ending, Regions};
use crate::surface::Kind;

/// What a part is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// A region with its surface.
    Surface(u32),
    /// One flat piece.
    Plane,
    /// Pieces that no surface explains.
    Free,
}

/// The pieces of a mesh in groups.
#[derive(Clone, Debug, Default)]
pub(crate) struct Parts {
    /// The part of each piece.
    pub of_piece: Vec<u32>,
    /// What each part is.
    pub forms: Vec<Form>,
}

impl Parts {
    /// The pieces of each part.
    pub fn pieces(&self) -> Vec<Vec<u32>> {
        let mut of_part = vec![Vec::new(); self.forms.len()];
        for (piece, &part) in self.of_piece.iter().enumerate() {
            of_part[part as usize].push(piece as u32);
        }
        of_part
    }
}

/// How many times larger than each smooth neighbour a flat piece is a plane of its own.
const MUCH_LARGER: f64 = 4.0;
/// The same of a piece of five vertices and more that may be a strip between two rulings; where all about it are told
/// already, of any size. The first strips of involutes are up to 9 times as large as the next.
const STRIP_LARGER: f64 = 10.0;
/// Share of its smooth border along which a flat piece that is a plane of its own touches accepted surfaces.
const TANGENT_SHARE: f64 = 0.5;

/// Groups the pieces: a part for each region and for each plane, and the rest united over what is no wall.
pub(crate) fn parts(view: View, regions: &Regions, tolerance: f64) -> Parts {
    let pieces = view.pieces;
    let planes: Vec<bool> = (0..pieces.count() as u32)
        .map(|piece| {
            regions.owner[piece as usize] == NONE && is_plane(view, regions, piece, tolerance)
        })
        .collect();
    grouped(view, regions, &planes)
}

/// All pieces as free forms, one between walls; no region owns any.
pub(crate) fn free(view: View, regions: &Regions) -> Parts {
    grouped(view, regions, &vec![false; view.pieces.count()])
}

/// A part for each region and for each of the pieces that are planes, and the rest united over what is no wall.
fn grouped(view: View, regions: &Regions, planes: &[bool]) -> Parts {
    let pieces = view.pieces;
    let mut sets = Sets::new(pieces.count());
    for region in regions.alive() {
        let own = &regions.all[region as usize].pieces;
        for &piece in own {
            sets.unite(own[0], piece);
        }
    }
    let free = |p: u32| regions.owner[p as usize] == NONE && !planes[p as usize];
    for link in pieces.links.iter().filter(|link| !link.wall) {
        let [a, b] = link.pieces;
        if free(a) && free(b) {
            sets.unite(a, b);
        }
    }
    let (of_piece, count) = sets.numbered();
    let mut forms = vec![Form::Free; count];
    for (piece, &part) in of_piece.iter().enumerate() {
        let owner = regions.owner[piece];
        if owner != NONE {
            forms[part as usize] = Form::Surface(owner);
        } else if planes[piece] {
            forms[part as usize] = Form::Plane;
        }
    }
    Parts { of_piece, forms }
}

/// Is an unowned piece a plane of its own?
fn is_plane(view: View, regions: &Regions, piece: u32, tolerance: f64) -> bool {
    let pieces = view.pieces;
    if pieces.certain[piece as usize] || pieces.smooth_links(piece).next().is_none() {
        return true;
    }
    let vertices = pieces.vertices.row(piece);
    if !view.is_flat(piece, tolerance) {
        return false;
    }
    // What has all its vertices on two lines may be a strip between two rulings.
    let may_be_strip = vertices.len() >= 5;
    if may_be_strip && is_certain_plane(view.ground.positions, vertices, tolerance) {
        return true;
    }
    let [mut largest, mut tangent, mut smooth] = [0.0f64; 3];
    for &link in pieces.around.row(piece) {
        let at = &pieces.links[link as usize];
        if at.wall {
            continue;
        }
        smooth += at.length;
        let across = at.across(piece);
        let owner = regions.owner[across as usize];
        if owner == NONE {
            if !pieces.certain[across as usize] {
                largest = largest.max(pieces.areas[across as usize]);
            }
        } else if regions.ending(view, &regions.all[owner as usize], across, link)
            == Ending::Tangent
        {
            tangent += at.length;
        }
    }
    // A triangle is flat whatever it lies on: among slivers of a free form many are larger than all about them.
    let least = if may_be_strip {
        STRIP_LARGER
    } else {
        MUCH_LARGER
    };
    let large = vertices.len() > 3 && pieces.areas[piece as usize] > least * largest;
    large || tangent > TANGENT_SHARE * smooth
}

/// A part on the way to others.
#[derive(Clone, Debug, Default)]
struct Island {
    area: f64,
    pieces: usize,
    /// Length of smooth border with each neighbour.
    beside: BTreeMap<u32, f64>,
    /// Length of border of what may be a crumb with each neighbour, walls as well.
    about: BTreeMap<u32, f64>,
}

/// Least share of an island's smooth border with the component it joins.
const ISLAND_SHARE: f64 = 0.34;
/// A component that takes islands in has this many pieces and so many times their area.
const TAKES_FROM: usize = 20;
const TAKES_AREA: f64 = 3.0;
/// A free form of so few pieces is an island, and a surface of so little evidence.
const FEW_PIECES: usize = 8;
const LITTLE_EVIDENCE: i64 = 25;
/// A crumb is a plane or a free form of so few pieces, smaller than those of the free form about it on average, which has
/// this share of its border, walls among it: slivers of a mesher may fold back on what they lie on.
const CRUMB_PIECES: usize = 2;
const CRUMB_SHARE: f64 = 0.5;

/// Small doubtful parts join the free form they lie in, smallest first.
pub(crate) fn join_islands(view: View, regions: &Regions, parts: &mut Parts) {
    for _ in 0..5 {
        if !join_islands_once(view, regions, parts) {
            return;
        }
    }
}

fn join_islands_once(view: View, regions: &Regions, parts: &mut Parts) -> bool {
    let pieces = view.pieces;
    let mut all = vec![Island::default(); parts.forms.len()];
    let mut most_vertices = vec![0; parts.forms.len()];
    for (piece, &part) in parts.of_piece.iter().enumerate() {
        all[part as usize].area += pieces.areas[piece];
        all[part as usize].pieces += 1;
        let vertices = pieces.vertices.row(piece as u32).len();
        most_vertices[part as usize] = vertices.max(most_vertices[part as usize]);
    }
    for link in &pieces.links {
        let [a, b] = link.pieces.map(|p| parts.of_piece[p as usize]);
        if a == b {
            continue;
        }
        for (part, other) in [(a, b), (b, a)] {
            let part = &mut all[part as usize];
            if part.pieces <= CRUMB_PIECES {
                *part.about.entry(other).or_default() += link.length;
            }
            if !link.wall {
                *part.beside.entry(other).or_default() += link.length;
            }
        }
    }
    let is_island = |part: usize| match parts.forms[part] {
        Form::Plane => most_vertices[part] <= 4,
        Form::Surface(region) => {
            let region = &regions.all[region as usize];
            region.surface.kind != Kind::Plane && region.evidence < LITTLE_EVIDENCE
        }
        Form::Free => all[part].pieces <= FEW_PIECES,
    };
    let may_be_crumb = |part: usize| {
        !matches!(parts.forms[part], Form::Surface(_)) && all[part].pieces <= CRUMB_PIECES
    };
    let mut islands: Vec<usize> = (0..all.len())
        .filter(|&part| all[part].pieces > 0 && (is_island(part) || may_be_crumb(part)))
        .collect();
    islands.sort_by(|&a, &b| all[a].area.total_cmp(&all[b].area));
    let mut into: Vec<u32> = (0..all.len() as u32).collect();
    let mut any = false;
    for island in islands {
        if into[island] != island as u32 {
            continue;
        }
        let own = &all[island];
        let takes = |part: u32| {
            let other = &all[part as usize];
            parts.forms[part as usize] == Form::Free
                && into[part as usize] == part
                && other.pieces >= TAKES_FROM
                && other.area >= TAKES_AREA * own.area
        };
        let is_smaller = |part: u32| {
            let other = &all[part as usize];
            own.area * (other.pieces as f64) < other.area
        };
        let [smooth, whole] = [&own.beside, &own.about].map(|all| all.values().sum::<f64>());
        let beside = own.beside.iter().filter(|&(&part, &length)| {
            takes(part) && is_island(island) && length >= ISLAND_SHARE * smooth
        });
        let about = own.about.iter().filter(|&(&part, &length)| {
            takes(part) && may_be_crumb(island) && is_smaller(part) && length >= CRUMB_SHARE * whole
        });
        let taker = beside.chain(about).max_by(|a, b| a.1.total_cmp(b.1));
        if let Some((&taker, _)) = taker {
            into[island] = taker;
            any = true;
        }
    }
    for part in &mut parts.of_piece {
        *part = into[*part as usize];
    }
    any
}
