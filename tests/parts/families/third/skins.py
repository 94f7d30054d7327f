"""Panels with spline faces, and blocks whose fillets change their radius."""
import math

import cadquery as cq
import numpy as np
from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet

from ..register import part
from ..second.outlines import counterbore, countersink, nearest, swelling
from ..shapes import W, disc, turned, joined, less


def blended(body, *fillets):
    """Fillets of varying radius: for each a point the edge is near to and the radii along it."""
    tool = BRepFilletAPI_MakeFillet(body.val().wrapped)
    for spot, radii in fillets:
        swelling(tool, body.edges(nearest(spot)).val(), radii)
    return W(obj=cq.Shape.cast(tool.Shape()).Solids()[0])


def under(height, outline, x, y):
    """What of a prism lies below a spline surface: height(x, y) on a grid of half widths x and y."""
    rows = [[cq.Vector(p, q, height(p, q)) for p in np.linspace(-x, x, 13)] for q in np.linspace(-y, y, 11)]
    top = cq.Face.makeSplineApprox(rows, tol=1e-3, maxDeg=5)
    return W(obj=min(outline.val().split(top).Solids(), key=lambda s: s.Center().z))


@part(turn=True, offset=1.0)
def seat_pan():
    height = lambda x, y: 16 + 0.004 * x * x - 7 * math.exp(-((y + 6) / 26) ** 2) * (1 - (x / 70) ** 2) + 0.06 * y
    prism = W("XY", origin=(0, 0, -20)).rect(96, 84).extrude(90).edges("|Z").fillet(22)
    body = under(height, prism, 64, 56).cut(under(lambda x, y: height(x, y) - 4.5, prism, 64, 56))
    core = under(lambda x, y: height(x, y) - 2, prism, 64, 56)
    body = joined(body, [disc(6, 40, -3, x, y).intersect(core) for x in (-24, 24) for y in (-20, 20)])
    body = less(body, [disc(2, 9, -4, x, y) for x in (-24, 24) for y in (-20, 20)])
    return body.cut(W("XY", origin=(0, 34, -20)).slot2D(30, 6).extrude(80))


@part(turn=True)
def rippled_tray():
    wave = [(x, 9 + 2.2 * math.sin(x / 5.2) + 0.02 * x) for x in np.linspace(-45, 45, 31)]
    tool = W("XZ", origin=(0, 28, 0)).spline(wave).lineTo(45, 40).lineTo(-45, 40).close().extrude(56)
    body = W().box(102, 68, 18, centered=(True, True, False)).edges("|Z").fillet(9).faces("<Z").edges().chamfer(1.5)
    body = body.cut(tool.intersect(W().box(86, 52, 80)))
    body = body.cut(W("XZ", origin=(0, 0, 18)).circle(7).extrude(60, both=True))
    return less(body, [countersink(1.8, 3.4, 30).translate((x, y, 18)) for x in (-46.5, 46.5) for y in (-20, 20)])


@part(turn=True, offset=1.0)
def sculpted_step():
    body = W().box(72, 44, 16, centered=(True, True, False)).union(W().box(30, 44, 20, centered=(True, True, False)).translate((21, 0, 14)))
    body = blended(body, ((6, 0, 16), (3, 11, 5)), ((36, 0, 34), (8, 3, 8)), ((-36, 0, 16), (2, 6, 9)), ((6, 0, 34), (2, 4, 1.5)))
    body = less(body, [counterbore(3, 5.5, 3.5, 40).translate((-20, y, 16)) for y in (-11, 11)])
    return body.cut(W("YZ", origin=(0, 0, 24)).circle(4).extrude(60)).cut(W("XZ", origin=(20, 0, 0)).slot2D(20, 8).extrude(60, both=True))


@part(turn=True)
def tapering_boss():
    body = W().box(64, 64, 10, centered=(True, True, False)).edges("|Z").chamfer(10).union(turned((0, 5), (15, 5), (15, 38), (0, 38)))
    body = blended(body, ((0, -15, 10), (3, 9, 4, 3)), ((0, 15, 38), (2, 5, 2)))
    body = body.cut(turned((0, -1), (9, -1), (9, 24), (7, 26), (7, 50), (0, 50)))
    return less(body, [disc(2.6, 40, -5, x, y) for x in (-24, 24) for y in (-18, 18)])


@part(turn=True, offset=0.5)
def lens_housing():
    height = lambda x, y: 20 + 5 * math.cos(x / 20) * math.cos(y / 24) - 0.0024 * (x + y) ** 2
    prism = W("XY").ellipse(42, 30).extrude(60)
    body = under(height, prism, 56, 44).cut(W("XY", origin=(0, 0, -1)).ellipse(38, 26).extrude(12))
    body = body.cut(disc(11, 60)).cut(turned((0, 15), (15, 15), (15, 60), (0, 60)))
    body = body.union(turned((11, 8), (13.5, 8), (13.5, 20), (11, 20)))
    return less(body, [disc(2, 60, 0, x, 0) for x in (-27, 27)]).cut(W("XZ", origin=(0, 0, 5)).rect(20, 5).extrude(60))
