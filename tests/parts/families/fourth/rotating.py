"""Discs, drums, joints and bearing parts."""
import math

import cadquery as cq

from ..register import part
from ..second.outlines import inside, lying
from ..shapes import W, disc, turned, around, joined, less, radial

smallest = cq.selectors.RadiusNthSelector


@part(turn=True, offset=1.0)
def brake_disc():
    body = turned((0, 0), (60, 0), (60, 3.5), (0, 3.5)).union(turned((0, 6.5), (60, 6.5), (60, 10), (0, 10)))
    vane = W().box(25, 3, 8, centered=(False, True, False)).translate((33.5, 0, 1)).edges("|Z").edges(">X").fillet(1.4)
    body = joined(body.cut(disc(33, 40, -5)), around(vane, 18))
    hat = turned((0, 4), (36, 4), (36, 10), (30, 24), (0, 24)).cut(turned((0, 3), (31, 3), (27, 20), (0, 20)))
    body = body.union(hat)
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 23.9), (1, 1, 24.1))).fillet(2)
    body = body.cut(disc(14, 60)).cut(turned((0, 23), (14, 23), (15.01, 24.01), (0, 24.01)))
    return less(body, around(disc(3, 60, 0, 20.5), 5)).cut(disc(2, 60, 0, *radial(20.5, math.radians(36))))


@part(turn=True)
def universal_cross():
    arm = lying(turned((0, 0), (8, 0), (8, 11), (6.5, 13), (6.5, 27), (5.8, 27.7), (0, 27.7)), "-x")
    body = W().sphere(12).intersect(W().box(40, 40, 20))
    body = joined(body, around(arm, 4))
    body = less(body, around(lying(turned((0, -6), (1.5, -6), (1.5, 0), (3, 1.01), (0, 1.01)), "+x").translate((27.7, 0, 0)), 4))
    body = body.union(turned((0, 8), (4.5, 8), (4.5, 13), (2.5, 13.5), (2.5, 15), (0, 15)))
    return body.cut(disc(1, 20, 2))


@part(turn=True, offset=0.5)
def coupling_spider():
    lobe = W("XY").polyline([(9, -3), (21, -5.5), (21, 5.5), (9, 3)]).close().extrude(11).edges("|Z").edges(">X").fillet(3)
    body = joined(disc(12, 11), around(lobe, 6))
    body = body.edges("|Z").edges(inside((-12.9, -12.9, 0), (12.9, 12.9, 11))).fillet(1.5)
    body = body.cut(turned((0, -1), (6, -1), (6, 12), (0, 12)))
    body = less(body, around(W().sphere(2).translate((16.5, 0, 11)), 6))
    return body.faces(">Z").edges("%CIRCLE").edges(inside((-1, -1, 10), (1, 1, 12))).chamfer(1)


@part(turn=True, offset=1.0)
def dog_clutch():
    body = turned((0, 0), (24, 0), (24, 9), (15, 9), (15, 24), (14, 25), (0, 25))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 8.9), (1, 1, 9.1))).edges(smallest(0)).fillet(3)
    dog = W().moveTo(*radial(13.5, -0.34)).threePointArc((13.5, 0), radial(13.5, 0.34)).lineTo(*radial(22.5, 0.3)).threePointArc((22.5, 0), radial(22.5, -0.3)).close()
    dog = dog.extrude(-8).edges("|Z").fillet(0.8).faces("<Z").edges().chamfer(0.6).translate((0, 0, 0.5))
    body = joined(body, around(dog, 5)).cut(turned((14.5, 15), (13.2, 15), (13.2, 20), (16, 20), (16, 15)))
    body = body.cut(disc(8, 60, -20))
    return less(body, around(W().box(5, 4, 60).translate((8.5, 0, 0)), 6))
