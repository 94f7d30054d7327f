#!/usr/bin/env python3
"""Reads the meshes of a folder back and checks them against their JSON, by none of what made them.

    check.py models

Exit status: 0 all is as promised, 1 something is not (each mesh is named with what) or nothing is there, 2 wrong use.
"""
import json
import sys
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

MOST_OFF = 2e-5  # a vertex off its analytic surface, as a share of the diagonal


def read_stl(path):
    """Distinct points and the triangles between them."""
    record = np.dtype([("normal", "<f4", 3), ("points", "<f4", (3, 3)), ("attribute", "<u2")])
    corners = np.frombuffer(path.read_bytes(), record, offset=84)["points"].reshape(-1, 3)
    points, index = np.unique(corners, axis=0, return_inverse=True)
    return points.astype(float), index.reshape(-1, 3)


def inner_edges(triangles):
    """The two triangles of each edge; None unless each edge has two, one each way."""
    ends = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    owner = np.repeat(np.arange(len(triangles)), 3)
    order = np.lexsort((ends[:, 0] > ends[:, 1], ends.max(1), ends.min(1)))
    ends, owner = ends[order], owner[order]
    if len(ends) % 2 or (ends[::2] != ends[1::2, ::-1]).any() or (np.diff(ends[::2], axis=0) == 0).all(1).any():
        return None
    return owner.reshape(-1, 2)


def regions(labels, pairs):
    """Number of edge-connected regions of equal label."""
    same = pairs[labels[pairs[:, 0]] == labels[pairs[:, 1]]]
    n = len(labels)
    return connected_components(coo_matrix((np.ones(len(same)), same.T), (n, n)), directed=False)[0]


def deviation(row, p):
    """How far points lie from the surface of a patch."""
    q = {k: np.array(v) for k, v in row["parameters"].items()}
    if row["type"] == "plane":
        return np.abs((p - q["point"]) @ q["normal"])
    if row["type"] == "sphere":
        return np.abs(np.linalg.norm(p - q["center"], axis=1) - q["radius"])
    d = p - q.get("point", q.get("apex", q.get("center")))
    h = d @ q["axis"]
    rho = np.linalg.norm(d - np.outer(h, q["axis"]), axis=1)
    if row["type"] == "cylinder":
        return np.abs(rho - q["radius"])
    if row["type"] == "cone":
        return np.abs(rho * np.cos(q["half_angle"]) - h * np.sin(q["half_angle"]))
    return np.abs(np.hypot(rho - q["major_radius"], h) - q["minor_radius"])


def gives_patches_away(labels):
    """Do triangles of one patch follow each other in the file?"""
    at_random = np.random.default_rng(0).permutation(labels)
    return np.abs(np.diff(labels)).mean() < 0.2 * np.abs(np.diff(at_random)).mean()


def faults(stem):
    """What is wrong with one mesh, and how far its vertices lie off their surfaces at most."""
    info = json.loads(stem.with_suffix(".json").read_text())
    p, t = read_stl(stem.with_suffix(".stl"))
    labels = np.array(stem.with_suffix(".seg").read_text().split(), int)
    stats, patches, found, worst = info["stats"], info["patches"], [], 0.0
    pairs = inner_edges(t)
    if pairs is None:
        return ["it is not closed and oriented"], worst
    if len(labels) != len(t) or set(labels) != set(range(len(patches))):
        return ["labels and triangles or patches do not match"], worst
    if (len(p), len(t), len(pairs)) != (stats["vertices"], stats["triangles"], stats["edges"]):
        found.append("counts")
    if regions(labels, pairs) != len(patches):
        found.append("patches are not edge-connected")
    if not (stats["vertex_manifold"] and stats["shells"] == 1 and stats["volume"] > 0 and stats["split_patches"] == 0):
        found.append("it is no single manifold body")
    corners = p[t]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    if not np.allclose(np.bincount(labels, areas), [row["area"] for row in patches], rtol=1e-6):
        found.append("areas")
    for row in patches:
        if row["parameters"]:
            off = deviation(row, p[np.unique(t[labels == row["label"]])]).max() / stats["diagonal"]
            worst = max(worst, off)
            if off > MOST_OFF:
                found.append(f"patch {row['label']} is {off:.1e} of the diagonal off its {row['type']}")
    across = np.sort(labels[pairs], axis=1)
    if set(map(tuple, across[across[:, 0] != across[:, 1]].tolist())) != {tuple(row["patches"]) for row in info["adjacency"]}:
        found.append("adjacency")
    if any(row["smooth"] is None for row in info["adjacency"]):
        found.append("smoothness unknown")
    if gives_patches_away(labels):
        found.append("the order of triangles gives patches away")
    return found, worst


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    stems = [seg.with_suffix("") for seg in sorted(Path(sys.argv[1]).glob("*.seg"))]
    told = {stem.name: faults(stem) for stem in stems}
    wrong = {name: found for name, (found, _) in told.items() if found}
    for name, found in wrong.items():
        print(f"{name}: {'; '.join(found)}")
    worst = max((off for _, off in told.values()), default=0.0)
    print(f"{len(told)} meshes checked, {len(wrong)} of them with faults; {worst:.1e} of the diagonal off a surface at most")
    return 1 if wrong or not told else 0


if __name__ == "__main__":
    sys.exit(main())
