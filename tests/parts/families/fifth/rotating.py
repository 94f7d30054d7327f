"""Wheels, gears and rotors."""
import math

import cadquery as cq

from ..register import part
from ..second.outlines import inside, lying
from ..shapes import W, disc, turned, around, joined, less, radial, toothed_wire
from ..third.sections import closed_curve, lofted
from .profiles import round_body, sector


def prism(wire, h):
    return W(obj=cq.Solid.extrudeLinear(wire, [], cq.Vector(0, 0, h)))


@part(turn=True, offset=1.0)
def planet_carrier():
    body = disc(32, 6).union(disc(32, 5, 24)).union(turned((0, -12), (11, -12), (12, -11), (12, 1), (0, 1)))
    post = sector(19, 31, 0.36, 26, 2).edges("|Z").edges("<X").fillet(3)
    body = joined(body.cut(disc(15, 40, 5)), [p.rotate((0, 0, 0), (0, 0, 1), 60) for p in around(post, 3)])
    body = less(body, around(disc(4, 60, -5, 22), 3))
    body = less(body, around(disc(6, 10, 28, 22), 3))
    return body.cut(turned((0, -12.01), (7.8, -12.01), (7, -11.2), (7, 10), (0, 10))).cut(W().box(3, 17, 14).translate((0, 0, -10)))


@part(turn=True)
def escape_wheel():
    tooth = W().moveTo(*radial(22, -0.13)).threePointArc(radial(26, 0.0), radial(30, 0.06)).lineTo(*radial(30.6, 0.1)).lineTo(*radial(22, 0.06)).close().extrude(1.6)
    body = joined(disc(23, 1.6).cut(disc(19.6, 4, -1)), around(tooth, 15))
    spoke = W().polyline([(3, -2.2), (20, -1.1), (20, 1.1), (3, 2.2)]).close().extrude(1.6)
    body = joined(body, around(spoke, 5)).union(disc(6, 1.6))
    body = body.edges("|Z").edges(inside((-19.9, -19.9, 0), (19.9, 19.9, 2))).fillet(0.8)
    return body.union(turned((0, -2), (3, -2), (3, 3.2), (2.6, 3.6), (0, 3.6))).cut(disc(1.2, 20, -5))


@part(turn=True, offset=1.0, scale=4)
def train_wheel():
    body = round_body((9, -3), (16, -3), (16, 5, 4), (36, 7, 5), (40, 1.5), (49, 1), (49, 6, 3), (43.6, 8, 3), (42.6, 22), (37, 22), (36, 12, 5),
                      (17, 11, 5), (16, 24), (9, 24))
    return less(body, around(disc(4, 60, -20, 27), 6)).cut(lying(disc(1.5, 20), "+x").translate((0, 0, 18)))


@part(turn=True, offset=1.0)
def cycloid_disc():
    pins, circle, pin, shift = 12, 34.0, 3.5, 1.7  # of the ring it rolls in

    def at(a):
        lean = math.atan2(math.sin((1 - pins) * a), circle / (shift * pins) - math.cos((1 - pins) * a))
        return circle * math.cos(a) - pin * math.cos(a + lean) - shift * math.cos(pins * a), circle * math.sin(a) - pin * math.sin(a + lean) - shift * math.sin(pins * a)
    body = prism(closed_curve(at, count=132), 7).union(disc(14, 10))
    body = body.cut(disc(9, 30, -5)).cut(turned((8, 3), (9.8, 3), (9.8, 5), (8, 5)))
    return less(body, around(disc(4.2, 30, -5, 20.5), 8)).cut(turned((15, -0.01), (17, -0.01), (16, 0.8)))


@part(turn=True, offset=0.5)
def sector_gear():
    wedge = W().polyline([(0, 0), (60, -60), (60, 60)]).close().extrude(6)
    rim = prism(toothed_wire(0, 36, 33, 38, 0.36, 0.13, 0.45), 6).cut(disc(27, 20, -5)).intersect(wedge)
    spokes = [W().polyline([(0, -4), (30, -3.5), (30, 3.5), (0, 4)]).close().extrude(6).rotate((0, 0, 0), (0, 0, 1), angle) for angle in (-31, 31)]
    body = joined(rim, spokes).union(disc(9, 16, -3))
    body = body.edges("|Z").edges(inside((17, -18, 0), (26, 18, 6))).fillet(1.5)
    return body.cut(disc(5, 40, -10)).cut(W("XZ", origin=(0, 0, 9.5)).circle(1.6).extrude(20)).faces(">Z").edges("%CIRCLE").chamfer(0.6)


@part(turn=True, offset=1.0)
def roots_rotor():
    lobes = lambda turn: lambda a: radial(21 + 7 * math.cos(3 * a) + 0.8 * math.cos(6 * a), a + turn)
    body = lofted([closed_curve(lobes(0.012 * z), cq.Plane((0, 0, z)), 36) for z in (0, 18, 36, 54)])
    body = body.union(turned((0, -24), (7, -24), (8, -23), (8, -8), (10, -8), (10, 1), (0, 1)))
    body = body.union(turned((0, 53), (10, 53), (10, 62), (8, 62), (8, 80), (6, 80), (6, 95), (5, 96), (0, 96)))
    body = body.cut(W("XY", origin=(7, 0, 87)).rect(4, 3).extrude(20)).cut(turned((0, -25), (1.5, -25), (1, -20), (0, -19)))
    return less(body, around(disc(3.4, 90, -10, 19), 3))
