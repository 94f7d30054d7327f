"""Blades, lofts and spline covers."""
import math

import cadquery as cq
import numpy as np

from .register import part
from .shapes import W, disc, turned, around, joined, less, radial, airfoil


@part(turn=True, offset=1.0)
def turbine_blade():
    wires = [airfoil(40 - 10 * s, 0.14 - 0.05 * s, 0.12 - 0.06 * s, 0.3 + 0.7 * s, 2 * s, 3 * s * s, 70 * s) for s in np.linspace(0, 1, 4)]
    body = W(obj=cq.Solid.makeLoft(wires, False)).union(W().box(56, 44, 8).translate((0, 0, -2)).edges("|Z").fillet(3))
    root = W("XZ").polyline([(-12, -6), (12, -6), (8, -12), (13, -18), (9, -24), (-9, -24), (-13, -18), (-8, -12)]).close().extrude(22, both=True)
    return body.union(root)


@part(uniform=False, turn=True)  # gmsh takes minutes over the blades
def propeller():
    wires = [airfoil(16 + 22 * s - 26 * s * s, 0.11 - 0.05 * s, 0.06, 0.9 - 0.65 * s, 0, 0, 5 + 55 * s) for s in np.linspace(0, 1, 4)]
    blade = W(obj=cq.Solid.makeLoft(wires, False)).rotate((0, 0, 0), (0, 1, 0), 90).rotate((0, 0, 0), (1, 0, 0), 90)
    nose = W("XZ", origin=(0, 0, 9)).moveTo(0, 0).lineTo(9, 0).spline([(8, 5), (5, 9.5), (0, 11.5)], tangents=[(0, 1), (-1, 0)], includeCurrent=True)
    hub = disc(9, 18, -9).union(nose.close().revolve(360, (0, 0, 0), (0, 1, 0)))
    return joined(hub, around(blade, 3)).cut(disc(3, 14, -10)).edges("<Z").edges(cq.selectors.RadiusNthSelector(-1)).chamfer(1)


@part()
def flask():
    curve = W("XZ").moveTo(0, 0).lineTo(24, 0).threePointArc((27.5, 1.5), (29, 5)).spline([(31, 25), (25, 48), (11, 62)], includeCurrent=True)
    curve = curve.lineTo(11, 78).lineTo(8, 78).lineTo(8, 62).spline([(21, 47), (26.5, 26), (22, 6)], includeCurrent=True)
    body = curve.lineTo(0, 4).close().revolve(360, (0, 0, 0), (0, 1, 0))
    return body.union(turned((10.5, 70), (13, 70.8), (13, 72.2), (10.5, 73))).cut(disc(11, 4, -2.8))


@part(turn=True, offset=2.0)
def square_to_round():
    loft = lambda w, r, z: W("XY").polygon(4, w * math.sqrt(2)).workplane(offset=z).circle(r).loft(ruled=True).rotate((0, 0, 0), (0, 0, 1), 45)
    outer = loft(60, 18, 50).union(W().box(80, 80, 5).translate((0, 0, -2.5)).edges("|Z").fillet(6)).union(disc(18, 20, 50))
    body = outer.cut(loft(54, 15.5, 50)).cut(disc(15.5, 40, 49.99)).cut(W().box(54, 54, 10).translate((0, 0, -5)))
    return less(body, [disc(3, 20, -10, x, y) for x in (-34, 34) for y in (-34, 34)])


@part(turn=True)
def swept_handle():
    rings = []
    for t in np.linspace(math.pi, 0, 9):
        plane = cq.Plane((45 * math.cos(t), 0, 36 * math.sin(t)), (0, 1, 0), (45 * math.sin(t), 0, -36 * math.cos(t)))
        rings.append(W(plane).ellipse(7 + 2 * math.sin(t), 4 + math.sin(t)).val())
    bar = W(obj=cq.Solid.makeLoft(rings, False))
    foot = lambda x: turned((0, -4), (12, -4), (12, -1), (11, 0), (0, 0)).cut(turned((0, -5), (3.2, -5), (3.2, -2), (0, -0.5))).translate((x, 0, 0))
    return bar.union(foot(-45)).union(foot(45))


@part(turn=True, offset=1.0)
def nozzle():
    curve = [(19, 12), (9, 28), (8, 34), (11, 46), (19, 70), (22.5, 90)]
    bore = W("XZ").moveTo(0, -1).lineTo(20, -1).lineTo(20, 6).spline(curve, includeCurrent=True).lineTo(0, 90).close().revolve(360, (0, 0, 0), (0, 1, 0))
    body = turned((0, 0), (38, 0), (38, 8), (26, 8), (26, 14), (14, 32), (14, 40), (25, 85), (25, 88), (0, 88))
    body = body.cut(bore).edges(cq.selectors.BoxSelector((-27, -27, 7.5), (27, 27, 8.5))).edges(cq.selectors.RadiusNthSelector(0)).fillet(3)
    return less(body, around(disc(3, 20, -1, 32.5), 8))


@part()
def spline_cam():
    n = 12
    points = [radial(30 + 9 * math.exp(-((a - 2) / 0.7) ** 2) + 4 * math.cos(2 * a), a) for a in np.arange(n) * 2 * math.pi / n]
    body = W().spline(points, periodic=True).close().extrude(12).faces(">Z or <Z").edges().chamfer(0.8)
    body = body.union(disc(14, 30, -8)).cut(disc(8, 60, -20)).cut(W().box(5, 10.5, 80).translate((0, 5.25, 0)))
    return less(body, around(disc(3.5, 40, -10, 20), 3))


@part()
def wave_cover():
    rows = [[(x, y, 10 + 3 * math.sin(x / 14) * math.cos(y / 12) + 0.002 * x * y) for x in np.linspace(-40, 40, 9)] for y in np.linspace(-30, 30, 7)]
    top = cq.Face.makeSplineApprox([[cq.Vector(*q) for q in row] for row in rows], tol=1e-3, maxDeg=5)
    prism = W(obj=cq.Solid.extrudeLinear(W().rect(60, 40).val(), [], cq.Vector(0, 0, 30)))
    parts = prism.edges("|Z").fillet(6).val().split(top)
    body = W(obj=min(parts.Solids(), key=lambda s: s.Center().z))
    return less(body, [disc(2.5, 40, -5, x, 0) for x in (-22, 22)])


@part(turn=True, offset=1.0)
def mouse_shell():
    outline = (W().moveTo(-30, 0).spline([(-20, 16), (5, 18), (32, 0)], tangents=[(0, 1), (0, -1)], includeCurrent=True)
               .spline([(5, -18), (-20, -16), (-30, 0)], tangents=[(0, -1), (0, 1)], includeCurrent=True).close())
    body = outline.extrude(18).faces(">Z").edges().fillet(5).faces("<Z").shell(-1.5)
    return body.cut(W("XY", origin=(18, 0, 10)).slot2D(12, 4).extrude(20))


@part(turn=True)
def spline_lever():
    body = (W().moveTo(0, -10).threePointArc((-10, 0), (0, 10)).spline([(30, 7), (60, 12)], tangents=[(1, 0), (1, 0)], includeCurrent=True)
            .threePointArc((66, 6), (60, 0)).spline([(30, -4), (0, -10)], tangents=[(-1, 0), (-1, 0)], includeCurrent=True).close().extrude(8))
    body = body.faces(">Z or <Z").edges().fillet(1.5).union(disc(7, 12))
    return less(body, [disc(4, 30, -5), disc(2.5, 30, -5, 60, 6)])


@part(offset=2.0)
def filleted_wave():
    return wave_cover().edges(cq.selectors.BoxSelector((-35, -25, 4), (35, 25, 25))).edges("not |Z").fillet(1.5)
