"""Gears, knobs, threads and bent bars."""
import math

import cadquery as cq
import numpy as np

from .register import part
from .shapes import W, disc, turned, around, joined, less, toothed_wire


@part(uniform=False, turn=True)
def knurled_knob():
    body = disc(15, 14).faces(">Z").edges().fillet(2).union(disc(9, 6, -6)).edges("<Z").chamfer(1)
    tooth = W("XY").center(15.2, 0).rect(1.3, 1.3).extrude(11.2).rotate((15.2, 0, 0), (15.2, 0, 1), 45)
    body = less(body, around(tooth, 30))
    return body.cut(disc(3, 30, -7)).cut(W().box(3, 2, 9).translate((3, 0, -4)))


@part(turn=True)
def lobe_knob():
    body = joined(disc(20, 14), around(disc(7, 14, 0, 21), 5))
    body = body.edges("|Z").fillet(6).edges(">Z").fillet(3).edges("<Z").fillet(1.5)
    return body.union(disc(9, 10, -8)).cut(turned((0, -9), (4, -9), (4, 3), (0, 5.3)))


@part(offset=0.7)
def spline_shaft():
    teeth = W(obj=cq.Solid.extrudeLinear(toothed_wire(0, 10, 8.6, 11, 0.33, 0.17, -0.5), [], cq.Vector(0, 0, 40)))
    shaft = turned((0, -30), (6, -30), (7, -29), (7, -8), (6.4, -8), (6.4, -5), (9, -5), (9, 0), (0, 0))
    return teeth.intersect(turned((0, 0), (12, 0), (12, 38), (9.5, 40), (0, 40))).union(shaft).cut(
        turned((0, 40.1), (2.6, 40.1), (2, 39), (2, 30), (0, 28.8)))


@part(turn=True, scale=4)
def spur_gear():
    body = W(obj=cq.Solid.extrudeLinear(toothed_wire(0, 18, 20.5, 25, 0.34, 0.13, 0.5), [], cq.Vector(0, 0, 9)))
    body = body.cut(turned((10, 7), (17, 7), (17.6, 9.01), (9.4, 9.01))).cut(disc(5, 30, -5)).union(turned((5, 0), (8, 0), (8, 15), (7, 16), (5, 16)))
    return less(body, around(disc(2.5, 20, -1, 13.5), 6)).cut(W("XZ", origin=(0, 0, 12)).circle(1.2).extrude(20))


@part()
def bevel_gear():
    wire = lambda z, k: toothed_wire(z, 16, 17 * k, 21 * k, 0.36, 0.13, 0.4)
    body = W(obj=cq.Solid.makeLoft([wire(0, 1.0), wire(9, 0.62)], True)).union(turned((0, -6), (11, -6), (11, 0), (0, 0)))
    return body.cut(disc(4, 60, -20)).cut(turned((0, 7), (6, 7), (8, 9.1), (0, 9.1)))


@part(turn=True, offset=0.5)
def helical_gear():
    count, z = 14, 12.0
    wires = [toothed_wire(z * s, count, 12.4, 16, 0.36, 0.11, 0.5, 0.35 * s) for s in np.linspace(0, 1, 4)]
    body = W(obj=cq.Solid.makeLoft(wires, False)).union(disc(7, 16))
    return body.cut(disc(4, 60, -20)).cut(W().box(3, 10.4, 60).intersect(W().box(3, 20, 80).translate((0, 10, 0))))


@part(uniform=False, offset=0.5)
def helix_bolt():
    path = cq.Wire.makeHelix(1.5, 10.5, 3.9)
    tooth = W("XZ", origin=(3.9, 0, 0)).polyline([(-0.3, -0.7), (0.9, -0.12), (0.9, 0.12), (-0.3, 0.7)]).close().sweep(W(obj=path), isFrenet=True)
    body = turned((0, -2), (3.9, -2), (3.9, 14), (0, 14)).union(tooth.translate((0, 0, 0.5)))
    return body.union(W("XY", origin=(0, 0, 14)).polygon(6, 13).extrude(4))


@part(turn=True)
def coil_spring():
    return W("XZ", origin=(10, 0, 0)).circle(1.3).sweep(W(obj=cq.Wire.makeHelix(5, 16, 10)), isFrenet=True)


@part(turn=True, offset=1.0)
def bent_wire():
    path = W("XZ").moveTo(0, 0).lineTo(0, 20).threePointArc((6 - 6 * math.sqrt(0.5), 20 + 6 * math.sqrt(0.5)), (6, 26)).lineTo(30, 26)
    path = path.threePointArc((30 + 8 * math.sqrt(0.5), 26 - 8 + 8 * math.sqrt(0.5)), (38, 18))
    path = path.lineTo(38, 10).threePointArc((44, 4), (50, 10)).lineTo(50, 40)
    body = W("XY").circle(2).sweep(path)
    return body.union(W("XY", origin=(50, 0, 40)).circle(2).extrude(3)).faces("<Z").edges().fillet(0.6)
