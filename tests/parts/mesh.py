"""Welded meshes: areas, edges, needles, connection."""
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from unusable import Unusable


def cross_area(points, triangles):
    a, b, c = (points[triangles[:, k]].astype(float) for k in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)


def altitude(points, triangles):
    """Least height of each triangle."""
    p = points[triangles].astype(float)
    longest = np.linalg.norm(p - np.roll(p, 1, axis=1), axis=2).max(1)
    return 2 * cross_area(points, triangles) / longest


def edge_pairs(triangles):
    """The two triangles of every edge (m, 2) and its ends (m, 2), or Unusable if the mesh is not closed."""
    directed = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    owner = np.repeat(np.arange(len(triangles)), 3)
    low, high = directed.min(1), directed.max(1)
    order = np.lexsort((directed[:, 0] > directed[:, 1], high, low))
    d, owner = directed[order], owner[order]
    if len(d) % 2 or (d[::2] != d[1::2, ::-1]).any() or (np.diff(d[::2], axis=0) == 0).all(1).any():
        key, count = np.unique(np.c_[low, high], axis=0, return_counts=True)
        raise Unusable(f"not closed, manifold and oriented: {(count == 1).sum()} open edges, "
                       f"{(count > 2).sum()} with more than two triangles, of {len(key)}")
    return owner.reshape(-1, 2), d[::2]


def flip_needles(points, triangles, owner, limit):
    """Gives a triangle without height to its neighbour across the longest edge (an edge flip); counts them."""
    fixed = 0
    for _ in range(6):
        flat = np.flatnonzero(altitude(points, triangles) <= limit)
        if not len(flat):
            break
        pair, ends = edge_pairs(triangles)
        touched = set()
        for t in flat:
            p = points[triangles[t]].astype(float)
            k = int(np.argmax(np.linalg.norm(p - np.roll(p, -1, axis=0), axis=1)))
            a, b, c = np.roll(triangles[t], -k)  # a-b is the longest edge, c lies on it
            e = np.flatnonzero(((ends == (a, b)) | (ends == (b, a))).all(1))[0]
            s = pair[e].sum() - t
            if s in touched or t in touched or owner[s] != owner[t]:
                continue
            d = triangles[s].sum() - a - b
            if ((ends == (min(c, d), max(c, d))) | (ends == (max(c, d), min(c, d)))).all(1).any():
                continue
            triangles[t], triangles[s] = (a, d, c), (d, b, c)
            touched |= {s, t}
            fixed += 1
    return fixed


def components(n, pairs):
    return connected_components(coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), (n, n)), directed=False)


def fans(triangles, pair, ends):
    """Number of triangle fans round vertices: equals the number of vertices if each has one."""
    corner = lambda t, v: 3 * t + np.argmax(triangles[t] == v[:, None], axis=1)
    links = [np.c_[corner(pair[:, 0], ends[:, k]), corner(pair[:, 1], ends[:, k])] for k in (0, 1)]
    return components(3 * len(triangles), np.concatenate(links))[0]
