"""Bodies with spline surfaces: impellers, ducts, covers, scrolls."""
import math

import cadquery as cq
import numpy as np
from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet

from ..register import part
from ..shapes import W, disc, turned, around, joined, less, radial
from .outlines import counterbore, inside, nearest, swelling


@part(turn=True, offset=1.0)
def impeller():
    hub = W("XZ").moveTo(0, 0).lineTo(44, 0).lineTo(44, 3).spline([(28, 6), (16, 14), (11, 28)], includeCurrent=True).lineTo(0, 28).close()
    hub = hub.revolve(360, (0, 0, 0), (0, 1, 0))
    shroud = W("XZ").moveTo(0, 2).lineTo(43, 2).lineTo(43, 9).threePointArc((30, 14), (24, 26)).lineTo(0, 26).close().revolve(360, (0, 0, 0), (0, 1, 0))
    way = [radial(9 + 37 * s, 1.1 * s ** 1.3) for s in np.linspace(0, 1, 6)]
    back = [(x - 1.6 * math.sin(1.1 * s), y + 1.6 * math.cos(1.1 * s)) for s, (x, y) in zip(np.linspace(0, 1, 6), way)]
    blade = W().spline(way).lineTo(*back[-1]).spline(back[::-1][1:], includeCurrent=True).close().extrude(30).intersect(shroud)
    return joined(hub, around(blade, 7)).cut(disc(5, 60, -10)).cut(W().box(3, 11.6, 60)).cut(turned((14, -1), (30, -1), (28, 1.2), (16, 1.2)))


@part(turn=True)
def oval_bottle():
    rings = [W("XY", origin=(0, 0, z)).ellipse(a, b).val() for z, a, b in ((0, 26, 16), (12, 29, 18), (40, 26, 17), (62, 27, 16), (78, 12, 11))]
    body = W(obj=cq.Solid.makeLoft(rings, False)).union(turned((0, 77), (9, 77), (9, 96), (0, 96)))
    body = body.union(turned((8, 80), (12.5, 80), (12.5, 82.5), (8, 84))).union(turned((8, 90), (9, 89), (10, 89.6), (10, 90.4), (9, 91), (8, 91)))
    body = body.cut(W("XY", origin=(0, 0, -1)).ellipse(20, 11).extrude(2.5)).cut(disc(7, 40, 70))
    return body.cut(W("XZ", origin=(0, -14, 30)).rect(26, 24).extrude(10).edges("|Y").fillet(4))


@part(turn=True, offset=1.0)
def intake_duct():
    stations = ((0, 0, 0, 16, 19), (2, 22, 0.15, 16, 20), (12, 46, 0.6, 14, 24), (32, 62, 1.1, 12, 28), (58, 70, 1.4, 11, 30))
    plane = lambda x, z, tilt: cq.Plane((x, 0, z), (math.cos(tilt), 0, -math.sin(tilt)), (math.sin(tilt), 0, math.cos(tilt)))
    loft = lambda t: W(obj=cq.Solid.makeLoft([W(plane(x, z, tilt)).ellipse(w - t, h - t).val() for x, z, tilt, w, h in stations], False))
    end = W(plane(58, 70, 1.4))
    body = loft(0).union(W("XY", origin=(0, 0, -6)).rect(54, 54).extrude(7).edges("|Z").fillet(9))
    body = body.union(end.workplane(offset=-1).rect(32, 76).extrude(7))
    body = body.cut(loft(2.5)).cut(W().ellipse(14.8, 17.8).extrude(-20)).cut(end.ellipse(10, 29).extrude(20))
    return less(body, [disc(3, 20, -10, x, y) for x in (-20, 20) for y in (-20, 20)])


@part(turn=True)
def oval_gland():
    body = W().ellipse(38, 22).extrude(9).faces(">Z").edges().fillet(2.5)
    body = body.union(turned((0, -18), (13, -18), (14, -17), (14, 9), (17, 9), (17, 15), (0, 15)))
    body = body.cut(turned((0, -20), (11, -20), (9, -16), (9, 13.5), (11, 16), (0, 16)))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 14.9), (1, 1, 15.1))).edges(cq.selectors.RadiusNthSelector(-1)).fillet(1.5)
    return less(body, [counterbore(3.2, 5.5, 3, 20).translate((x, 0, 9)) for x in (-27, 27)])


@part(turn=True, offset=1.0)
def crowned_panel():
    height = lambda x, y: 12 * math.cos(x / 52) + 5 * math.cos(y / 26) + 1.5 * math.sin(x / 17 + y / 30)
    def below(lift):
        rows = [[cq.Vector(x, y, height(x, y) + lift) for x in np.linspace(-70, 70, 15)] for y in np.linspace(-50, 50, 11)]
        top = cq.Face.makeSplineApprox(rows, tol=1e-3, maxDeg=5)
        prism = W("XY", origin=(0, 0, -10)).rect(110, 76).extrude(60).edges("|Z").fillet(14).val()
        return W(obj=min(prism.split(top).Solids(), key=lambda s: s.Center().z))
    body = below(0).cut(below(-4))
    body = joined(body, [disc(6, 20, -5, x, y).intersect(below(-2)) for x in (-40, 40) for y in (-24, 24)])
    body = less(body, [disc(2.2, 9, -6, x, y) for x in (-40, 40) for y in (-24, 24)])
    return body.cut(W().slot2D(44, 16).extrude(60)).cut(W("XY").rarray(1, 9, 1, 5).slot2D(14, 3).extrude(60).translate((38, 0, 0)))


@part(turn=True, offset=0.5)
def scroll_housing():
    def outline(thick, z, h):
        turn = [radial(26 + 2.9 * a - thick, a) for a in np.linspace(0.55, 2 * math.pi, 14)]
        wall = lambda y: (turn[-1][0] + 2.9 * y / turn[-1][0], y)  # tangent to the scroll
        duct = [wall(46), (turn[0][0], 46)] if not thick else [wall(60), (26, 60), (26, 12.5)]
        start = W("XY", origin=(0, 0, z)).spline(turn)
        for q in duct:
            start = start.lineTo(*q)
        return start.close().extrude(h)
    body = outline(0, 0, 26).union(W().box(38, 4, 38).translate((35, 44, 13)).edges("|Y").fillet(4)).union(disc(12, 8, -8))
    body = body.union(turned((15, 26), (18, 26), (18, 29), (19, 30), (19, 32), (15, 32)))
    body = body.cut(outline(2.5, 2.5, 21)).cut(disc(15, 40, 20)).cut(disc(5, 40, -20)).cut(disc(8, 5, -8.01))
    return less(body, [W("XZ", origin=(x, 40, z)).circle(1.7).extrude(-20) for x in (20, 50) for z in (-2, 28)])


@part(turn=True)
def face_cam():
    points = [radial(28 + 4 * math.cos(2 * a) + 3 * math.sin(a), a) for a in np.arange(14) * 2 * math.pi / 14]
    wider = lambda x, y, add: (x * (1 + add / math.hypot(x, y)), y * (1 + add / math.hypot(x, y)))
    curve = lambda add: W("XY", origin=(0, 0, 6)).spline([wider(*q, add) for q in points], periodic=True).close().extrude(10)
    body = turned((0, -8), (12, -8), (12, 0), (42, 0), (44, 2), (44, 10), (43, 11), (0, 11)).cut(curve(3.5).cut(curve(-3.5)))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, -0.1), (1, 1, 0.1))).edges(cq.selectors.RadiusNthSelector(0)).fillet(3)
    body = body.cut(disc(6, 60, -20)).cut(W().box(4, 15.4, 60))
    return less(body, around(counterbore(1.7, 3, 2, 40).translate((14.5, 0, 11)), 3))


@part(uniform=False, turn=True)
def worm_shaft():
    path = cq.Wire.makeHelix(8, 32, 9)
    tooth = W("XZ", origin=(9, 0, 0)).polyline([(-0.6, -2.6), (3.6, -1.2), (3.6, 1.2), (-0.6, 2.6)]).close().sweep(W(obj=path), isFrenet=True)
    body = turned((0, -6), (9, -6), (9, 38), (0, 38)).union(tooth)
    body = body.intersect(turned((0, -6), (8, -6), (14, 0), (14, 32), (8, 38), (0, 38)))
    body = body.union(turned((0, -26), (5, -26), (6, -25), (6, -6), (0, -6))).union(turned((0, 38), (6, 38), (6, 52), (5, 53), (0, 53)))
    return body.cut(W().box(2, 20, 8).translate((5.5, 0, -20)))


@part(turn=True, offset=1.0)
def twisted_bar():
    mid = W("XY").rect(12, 12).twistExtrude(50, 180)
    body = mid.union(W("XY").rect(12, 12).extrude(-20)).union(W("XY", origin=(0, 0, 50)).rect(12, 12).extrude(20))
    body = body.union(disc(14, 6, 68)).union(turned((0, -46), (5, -46), (6, -45), (6, -20), (0, -20)))
    return less(body, [disc(2, 20, 60, x, y) for x, y in ((8, 8), (-8, 8), (8, -8), (-8, -8))])


@part(turn=True, offset=1.0)
def blended_block():
    body = W().box(60, 40, 12, centered=(True, True, False)).union(W().box(24, 40, 40, centered=(True, True, False)).translate((-18, 0, 0)))
    tool = BRepFilletAPI_MakeFillet(body.val().wrapped)
    for q, radii in (((-6, 0, 12), (4, 13, 6)), ((-6, 0, 40), (2, 8, 3)), ((-30, 0, 40), (9, 2, 6))):
        swelling(tool, body.edges(nearest(q)).val(), radii)
    body = W(obj=cq.Shape.cast(tool.Shape()).Solids()[0])
    return less(body, [counterbore(3, 5.5, 3, 40).translate((20, y, 12)) for y in (-11, 11)] + [W("YZ", origin=(-40, 0, 26)).circle(7).extrude(60)])
