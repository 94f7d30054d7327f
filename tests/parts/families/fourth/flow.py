"""What water and air flow through or past: spouts, tubes, fins, guides."""
import cadquery as cq
import numpy as np

from ..register import part
from ..second.outlines import inside
from ..shapes import W, disc, turned, around, joined, less
from ..third.sections import closed_curve, foil, lofted, squarish, tilted


@part(turn=True, offset=1.0)
def swan_spout():
    path = cq.Edge.makeSpline([cq.Vector(0, 0, 10), cq.Vector(2, 0, 60), cq.Vector(38, 0, 104), cq.Vector(84, 0, 70)],
                              tangents=[cq.Vector(0, 0, 1), cq.Vector(0.25, 0, -1)])
    pipe = lambda r: W("XY", origin=(0, 0, 10)).circle(r).sweep(W(obj=path))
    body = pipe(9).union(turned((0, 0), (20, 0), (20, 3), (14, 12), (14, 22), (12, 24), (0, 24)))
    tip = W(cq.Plane((84, 0, 70), (0, 1, 0), (0.25, 0, -1))).workplane(offset=-3)
    body = body.union(tip.circle(11).extrude(14)).cut(pipe(6.5)).cut(disc(6.5, 11, -1))
    return body.cut(tip.workplane(offset=-0.2).circle(8.5).extrude(20)).cut(W("XZ", origin=(0, 0, 17)).circle(2).extrude(30)).cut(turned((16, -1), (18, -1), (18, 1), (16, 1)))


@part(turn=True)
def venturi_tube():
    curve = W("XZ").moveTo(0, -1).lineTo(15, -1).lineTo(15, 0).spline([(13.5, 10), (6.5, 26), (6, 34), (9, 58), (15, 90)], tangents=[(0, 1), (0.15, 1)], includeCurrent=True)
    bore = curve.lineTo(15, 91).lineTo(0, 91).close().revolve(360, (0, 0, 0), (0, 1, 0))
    body = turned((0, 0), (19, 0), (19, 8), (11, 26), (11, 38), (19, 82), (19, 90), (0, 90))
    body = body.union(disc(30, 7)).union(disc(30, 7, 83))
    taps = [W("YZ", origin=(0, 0, z)).circle(5).extrude(24) for z in (14, 32)]
    body = joined(body, taps).cut(bore)
    body = less(body, [W("YZ", origin=(0, 0, z)).circle(1.8).extrude(30) for z in (14, 32)])
    body = less(body, around(disc(2.6, 120, -10, 24.5), 6))
    return body.faces("<Z or >Z").edges("%CIRCLE").edges(cq.selectors.RadiusNthSelector(-1)).chamfer(1)


@part(turn=True, offset=1.0)
def surfboard_fin():
    wires = [foil(72 - 44 * s ** 1.4, 0.16, 0.0, 0.0, 40 * s ** 1.3, 0, 92 * s) for s in np.linspace(0, 1, 5)]
    body = lofted(wires).union(W().box(84, 15, 16).translate((2, 0, -6)).edges("|Y").edges("<Z").fillet(5))
    body = body.cut(W().box(6, 20, 8).translate((-40, 0, -12))).cut(W("XZ", origin=(26, 0, -7)).circle(2.2).extrude(20, both=True))
    return less(body, [W("XZ", origin=(x, -7.51, -6)).slot2D(16, 5).extrude(-1.6) for x in (-18, 6)])


@part(turn=True, offset=0.5)
def draft_elbow():
    rows = ((0, 0, 0.0, 16, 16, 2.0), (3, 26, 0.35, 17, 15, 2.2), (20, 48, 1.1, 22, 13, 2.7), (52, 58, 1.5, 30, 11, 3.2), (86, 60, 1.57, 36, 12, 3.6))
    solid = lambda thin: lofted([closed_curve(squarish(b - thin, a - thin, p), tilted(x, z, angle), 32) for x, z, angle, a, b, p in rows])
    body = solid(0).union(disc(27, 6, -6)).union(W("YZ", origin=(84, 0, 60)).rect(92, 40).extrude(6).edges("|X").fillet(5))
    body = body.cut(solid(2.5)).cut(disc(13.5, 10, -8))
    body = body.cut(W("YZ", origin=(85.9, 0, 60)).rect(62, 17).extrude(10).edges("|X").fillet(3))
    body = less(body, around(disc(2, 30, -10, 22), 8))
    return less(body, [W("YZ", origin=(70, y, 60 + z)).circle(2).extrude(40) for y in (-41, 41) for z in (-15, 15)])


@part(turn=True)
def snorkel():
    path = cq.Edge.makeSpline([cq.Vector(0, 0, 0), cq.Vector(0, 34, 16), cq.Vector(-9, 50, 70), cq.Vector(-2, 36, 150)],
                              tangents=[cq.Vector(0, 1, 0), cq.Vector(0.2, -0.3, 1)])
    start = cq.Plane((0, 0, 0), (1, 0, 0), (0, 1, 0))
    tube = lambda r: W(start).circle(r).sweep(W(obj=path))
    body = tube(10).union(W(start).workplane(offset=-6).slot2D(46, 24).extrude(7))
    top = W(cq.Plane((-2, 36, 150), (1, 0, -0.2), (0.2, -0.3, 1)))
    body = body.union(top.workplane(offset=-8).circle(13).extrude(16)).cut(tube(8))
    body = body.cut(W(start).workplane(offset=-7).slot2D(24, 10).extrude(7.1)).cut(top.workplane(offset=-0.1).circle(10).extrude(20))
    return body.cut(top.workplane(offset=4).rect(4, 40).extrude(8))


@part(turn=True, offset=1.0)
def guide_vane():
    vane = lofted([foil(40 - 4 * s, 0.2 - 0.03 * s, 0.09, 0.5 + 0.25 * s, 0, 0, 34 * s) for s in np.linspace(0, 1, 4)])
    body = vane.union(turned((0, -5), (26, -5), (26, 0.4), (0, 0.4))).union(turned((0, 33.6), (26, 33.6), (26, 38), (0, 38)))
    body = body.union(turned((0, -30), (6, -30), (7, -29), (7, -14), (9, -14), (9, -5), (0, -5))).union(turned((0, 38), (7, 38), (7, 50), (6, 51), (0, 51)))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, -5.1), (1, 1, -4.9))).edges(cq.selectors.RadiusNthSelector(0)).fillet(2)
    return body.cut(W().box(20, 20, 9).translate((13.5, 0, -26))).cut(turned((0, 40), (2.5, 40), (2.5, 52), (0, 52)))
