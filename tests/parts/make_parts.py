#!/usr/bin/env python3
"""CAD parts with ground truth, in the format of the bench.

    make_parts.py [--series 1|2|3|4|5|6] [--out models] [--only NAME ...] [--variants coarse fine uniform]

Exit status: 0 all made, 1 some part or mesh is not usable; each is named with its reason, the others are made.
"""
import argparse
import sys
import time
import zlib
from pathlib import Path

import cadquery as cq
import numpy as np
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepTools import BRepTools

from families import SERIES
from surfaces import Face, unit
from unusable import Unusable
from write import make


def placed(shape, name, turn, offset):
    """The solid, turned by an arbitrary rotation and moved off the origin, in its own units."""
    rng = np.random.default_rng(zlib.crc32(name.encode()))
    size = shape.BoundingBox().DiagonalLength
    if turn:
        shape = shape.rotate(cq.Vector(0, 0, 0), cq.Vector(*unit(rng.normal(size=3))), float(rng.uniform(20, 340)))
    if offset:
        shape = shape.translate(cq.Vector(*(unit(rng.normal(size=3)) * offset * size)))
    return shape


def build(name, part):
    """The finished solid of a registered part, or Unusable."""
    function, _, turn, offset, scale = part
    try:
        solids = function().val().Solids()
    except Exception as error:
        raise Unusable(f"the kernel cannot build it: {error}") from error
    if len(solids) != 1:
        raise Unusable(f"{len(solids)} solids, not one")
    shape = placed(solids[0].scale(scale) if scale != 1 else solids[0], name, turn, offset)
    if not BRepCheck_Analyzer(shape.wrapped).IsValid() or shape.Volume() <= 0:
        raise Unusable("the solid is not valid")
    return shape


def faces_of(shape, diagonal):
    """The faces of a solid, sampled on a mesh of their own so that every variant has the same types."""
    BRepTools.Clean_s(shape.wrapped)
    BRepMesh_IncrementalMesh(shape.wrapped, 1e-3 * diagonal, False, 0.2, False)
    return [Face(face.wrapped, diagonal) for face in shape.Faces()]


def make_part(name, part, variants, out):
    """Makes the meshes of a part; returns what could not be made, in words."""
    skipped = []

    def skip(what, error):
        skipped.append(f"{what}: {error}")
        print("SKIPPED", skipped[-1], flush=True)

    try:
        shape = build(name, part)
        diagonal = shape.BoundingBox(1e-4).DiagonalLength
        faces = faces_of(shape, diagonal)
    except Unusable as error:
        skip(name, error)
        return skipped
    for variant in variants:
        if variant == "uniform" and not part[1]:
            continue
        start = time.time()
        try:
            info = make(name, variant, shape, faces, diagonal, out)
        except Unusable as error:
            skip(f"{name}-{variant}", error)
            continue
        stats = info["stats"]
        print(f"{info['name']:26} {stats['triangles']:7} triangles {stats['patches']:4} patches  {stats['diagonal']:7.1f} mm "
              f"{time.time() - start:5.1f} s  {info['types']} {'; '.join(info['problems'])}", flush=True)
    return skipped


def main():
    args = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    args.add_argument("--series", type=int, default=1, choices=list(SERIES))
    args.add_argument("--out", type=Path, default=Path("models"))
    args.add_argument("--only", nargs="*", metavar="NAME")
    args.add_argument("--variants", nargs="*", default=["coarse", "fine", "uniform"], choices=["coarse", "fine", "uniform"])
    usage, args = args, args.parse_args()
    parts = SERIES[args.series]
    names = list(parts) if args.only is None else args.only
    if unknown := [name for name in names if name not in parts]:
        usage.error(f"not in series {args.series}: {', '.join(unknown)}")
    args.out.mkdir(parents=True, exist_ok=True)
    skipped = []
    for name in names:
        for suffix in (f"-{v}.{e}" for v in args.variants for e in ("stl", "seg", "json")):
            (args.out / (name + suffix)).unlink(missing_ok=True)
        skipped += make_part(name, parts[name], args.variants, args.out)
    print(f"{len(skipped)} skipped" + "".join(f"\n  {line}" for line in skipped))
    return 1 if skipped else 0


if __name__ == "__main__":
    sys.exit(main())
