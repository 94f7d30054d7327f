"""One mesh made, checked against its solid, and written as NAME-VARIANT.stl, .seg and .json."""
import json
import zlib
from pathlib import Path

import numpy as np
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps

from label import Labels, adjacency
from mesh import altitude, components, cross_area, edge_pairs, fans, flip_needles
from surfaces import ANALYTIC
from tessellate import KERNEL, kernel_mesh, orient, uniform_mesh, weld
from unusable import Unusable


def make(name, variant, shape, faces, diagonal, out):
    """Tessellates, labels, checks and writes one mesh; returns its JSON.

    gmsh now and then puts a vertex off its surface: another of its algorithms mostly does not.
    """
    if variant != "uniform":
        return finish(name, variant, shape, faces, diagonal, out, kernel_mesh(shape, diagonal, *KERNEL[variant]))
    errors = []
    for algorithm in (6, 5, 1):  # frontal Delaunay, Delaunay, MeshAdapt
        try:
            return finish(name, variant, shape, faces, diagonal, out, uniform_mesh(shape, algorithm))
        except Unusable as error:
            errors.append(str(error))
    raise Unusable("; ".join(errors))


def finish(name, variant, shape, faces, diagonal, out, raw):
    """Welds, labels, checks and writes a tessellation."""
    rng = np.random.default_rng(zlib.crc32(f"{name}-{variant}".encode()))
    raw = (raw[0], orient(raw[1], raw[2], raw[0], faces), raw[2])
    points, triangles, owner = weld(*raw, diagonal)
    edge_pairs(triangles)
    fixed = flip_needles(points, triangles, owner, 1e-7 * diagonal)
    points, triangles, owner = shuffled(points, triangles, owner, rng)

    pair, ends = edge_pairs(triangles)
    areas, heights, n = cross_area(points, triangles), altitude(points, triangles), len(triangles)
    if not heights.min() > 1e-8 * diagonal:
        raise Unusable(f"{(heights <= 1e-8 * diagonal).sum()} triangles without area")
    p = points.astype(float)
    body = same_body(shape, p, triangles, areas.sum(), 0.2 if variant == "coarse" else 0.03)

    labels = Labels(faces, owner, pair)
    patches = labels.rows(p, triangles, areas, diagonal)
    labels.check_free_forms(p, triangles, diagonal, rng)
    inner = labels.of_triangle[pair[:, 0]] == labels.of_triangle[pair[:, 1]]
    split = components(n, pair[inner])[0] - labels.count

    stats = {"vertices": len(points), "triangles": n, "edges": len(pair), "watertight": True, "edge_manifold": True,
             "vertex_manifold": fans(triangles, pair, ends) == len(points), "oriented": True,
             "shells": int(components(n, pair)[0]), "euler": len(points) - len(pair) + n,
             "bbox_min": p.min(0).tolist(), "bbox_max": p.max(0).tolist(),
             "diagonal": float(np.linalg.norm(p.max(0) - p.min(0))), "area": float(areas.sum()), "volume": body["volume"],
             "min_relative_altitude": float(heights.min() / diagonal), "brep_area": body["brep_area"],
             "brep_volume": body["brep_volume"], "patches": len(patches), "fixed_triangles": fixed, "split_patches": int(split),
             "max_vertex_deviation": max((row.get("max_vertex_deviation", 0.0) for row in patches), default=0.0)}
    types = {kind: sum(row["type"] == kind for row in patches) for kind in (*ANALYTIC, "bspline", "other")}
    info = {"name": f"{name}-{variant}", "variant": variant, "source": "tests/parts", "stats": stats,
            "types": {k: v for k, v in types.items() if v}, "patches": patches,
            "adjacency": adjacency(p, pair[~inner], ends[~inner], labels.of_triangle, owner, faces, patches),
            "problems": labels.problems()}
    write(out / f"{name}-{variant}", points, triangles, labels.of_triangle, info)
    return info


def shuffled(points, triangles, owner, rng):
    """Triangles, their first corners and vertices in an order that tells nothing of the patches."""
    order = rng.permutation(len(triangles))
    turn = (rng.integers(0, 3, len(order))[:, None] + np.arange(3)) % 3
    triangles, owner = np.take_along_axis(triangles[order], turn, axis=1), owner[order]
    rename = rng.permutation(len(points))
    return points[np.argsort(rename)], rename[triangles], owner


def same_body(shape, p, triangles, area, slack):
    """Volume of the mesh, area and volume of the solid; Unusable if they differ by more than a share of `slack`."""
    a, b, c = (p[triangles[:, k]] - p[0] for k in range(3))
    volume = float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)
    brep_volume, brep_area = exact_volume(shape), shape.Area()
    if abs(volume / brep_volume - 1) > slack or abs(area / brep_area - 1) > slack:
        raise Unusable(f"the mesh is another body: volume {volume:.6g} for {brep_volume:.6g}, area {area:.6g} for {brep_area:.6g}")
    return {"volume": volume, "brep_volume": brep_volume, "brep_area": brep_area}


def exact_volume(shape):
    """By adaptive quadrature: the plain one is several percent off on long spline faces."""
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape.wrapped, properties, 1e-4, False, False)
    return properties.Mass()


def write(stem, points, triangles, labels, info):
    """Binary STL, labels one a line, JSON."""
    record = np.zeros(len(triangles), [("normal", "<f4", 3), ("points", "<f4", (3, 3)), ("attribute", "<u2")])
    record["points"] = points[triangles]
    p = points[triangles].astype(float)
    normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    record["normal"] = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    header = np.array([len(triangles)], "<u4").tobytes()
    Path(f"{stem}.stl").write_bytes(b"tests/parts".ljust(80) + header + record.tobytes())
    Path(f"{stem}.seg").write_text("\n".join(map(str, labels.tolist())) + "\n")
    Path(f"{stem}.json").write_text(json.dumps(info, indent=1) + "\n")
