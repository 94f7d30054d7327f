"""Parts as they come from a system that writes every face as a spline: the surfaces are the five all the same."""
import math

import cadquery as cq
from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert

from ..register import part
from ..second.outlines import counterbore, countersink, inside, link
from ..shapes import W, disc, turned, around, less


def as_splines(body):
    """The same solid, every face and edge a rational spline."""
    return W(obj=cq.Shape.cast(BRepBuilderAPI_NurbsConvert(body.val().wrapped, True).Shape()))


@part(turn=True, offset=1.0)
def spline_stored_gland():
    body = turned((0, 0), (22, 0), (22, 6), (14, 6), (12, 24), (0, 24))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 5.9), (1, 1, 6.1))).edges(cq.selectors.RadiusNthSelector(0)).fillet(3)
    body = body.faces("<Z").edges().chamfer(0.8).edges(">Z").fillet(1.5)
    body = body.cut(turned((0, -1), (7, -1), (7, 14), (9, 18), (9, 30), (0, 30)))
    return as_splines(less(body, around(counterbore(1.7, 3, 1.5, 20).translate((18, 0, 6)), 4)))


@part(turn=True, offset=0.5)
def spline_stored_latch():
    body = link(11, 6, 40, 8).union(disc(9, 14)).union(W().box(16, 5, 8, centered=(True, True, False)).translate((48, 3, 0)).edges("|Z and >X").fillet(2))
    body = body.faces(">Z").edges().chamfer(0.7).cut(disc(5, 40, -5)).cut(disc(2.5, 40, -5, 40))
    body = body.cut(W("XY", origin=(22, 0, 4)).slot2D(18, 6).extrude(20)).edges(inside((10, -4, 3.9), (32, 4, 4.1))).fillet(1)
    return as_splines(body.cut(W("XZ", origin=(0, 0, 10)).circle(1.2).extrude(20, both=True)))


@part(turn=True)
def spline_stored_cap():
    R = (20 ** 2 + 7 ** 2) / 14  # of the dome, centred on the axis
    profile = W("XZ").moveTo(0, 0).lineTo(23, 0).lineTo(23, 3).lineTo(20, 5).lineTo(20, 18).threePointArc((11, 25 - R + math.sqrt(R * R - 121)), (0, 25))
    body = profile.close().revolve(360, (0, 0, 0), (0, 1, 0))
    body = body.cut(turned((0, -1), (17, -1), (17, 15), (14, 18), (0, 18)))
    body = less(body, around(W("XY", origin=(0, 0, 7)).moveTo(20.5, 0).circle(1.5).extrude(9), 12))
    return as_splines(body.union(turned((0, 13), (3, 13), (4, 14), (4, 19), (0, 19))))


@part(turn=True, offset=1.0)
def spline_stored_bracket():
    body = W("XZ").polyline([(0, 0), (46, 0), (46, 6), (6, 6), (6, 38), (0, 38)]).close().extrude(16, both=True)
    body = body.edges("|Y").edges(inside((5, -1, 5), (7, 1, 7))).fillet(5).edges("|Z").edges(">X").fillet(8).edges("|X").edges(">Z").fillet(6)
    body = body.edges("|Y").edges(inside((-1, -1, -1), (1, 1, 1))).fillet(3)
    eye = W("YZ", origin=(6, 0, 26)).circle(9).extrude(8).faces(">X").edges().fillet(1.5)
    body = body.union(eye).cut(W("YZ", origin=(-5, 0, 26)).circle(5).extrude(40))
    return as_splines(less(body, [countersink(2.2, 4.4, 20).translate((x, y, 6)) for x, y in ((34, 7), (34, -7))]))
