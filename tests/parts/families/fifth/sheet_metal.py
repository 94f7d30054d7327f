"""Parts cut, bent and pressed from sheet."""
import numpy as np

from ..register import part
from ..second.outlines import inside, link, lying, rounded_rect, sheet
from ..shapes import W, disc, turned, joined, less


@part(turn=True, offset=1.0)
def joist_hanger():
    body = sheet([(-24, 96), (-24, 0), (24, 0), (24, 96)], 1.5, 2, 52)
    body = body.cut(W().box(100, 12, 40).translate((0, -26, 6)))  # relief below the wings
    wing = W().box(30, 1.5, 70, centered=(False, True, False)).translate((23.25, -25.25, 26)).edges("|Y").edges(">X").chamfer(7)
    body = body.union(wing).union(wing.mirror("YZ"))
    body = body.edges("|Z").edges(inside((23, -27, 30), (24, -25, 90)) + inside((-24, -27, 30), (-23, -25, 90))).fillet(3)
    body = body.edges("|Z").edges(inside((24.5, -25, 30), (25, -24, 90)) + inside((-25, -25, 30), (-24.5, -24, 90))).fillet(1.5)
    body = less(body, [W("XZ", origin=(s * x, 0, z)).circle(2.1).extrude(40) for s in (-1, 1) for x in (33, 45) for z in (42, 61, 80)])
    body = less(body, [W("YZ", origin=(-40, y, z)).circle(2.1).extrude(80) for y, z in ((-4, 40), (12, 60), (-4, 80), (12, 20))])
    return less(body, [disc(1.6, 10, -5, 0, y) for y in (-8, 14)])


@part(turn=True, offset=2.0)
def shield_can():
    body = rounded_rect(26, 19, 1.2, 3.2).faces(">Z").edges().fillet(0.6).cut(rounded_rect(25.4, 18.4, 0.9, 2.9).faces(">Z").edges().fillet(0.3))
    body = less(body, [disc(0.55, 6, 0, x, y) for x in np.arange(-9, 9.1, 3) for y in (-6, -3, 3, 6)])
    body = body.cut(W().box(60, 1.6, 2.4).translate((0, 5, 0))).cut(W().box(60, 1.6, 2.4).translate((0, -5, 0)))
    return less(body, [W().box(2.2, 60, 2.4).translate((x, 0, 0)) for x in (-8, 0, 8)]).cut(W("XY").slot2D(3, 0.9).extrude(6))


@part(turn=True, scale=2)
def cable_lug():
    wedge = W("XZ").polyline([(-26, -8), (-26, 8), (2, 8), (14, -1.4), (14, -4), (9, -4), (3, -8)]).close().extrude(12, both=True)
    body = W("YZ", origin=(-26, 0, 0)).circle(6).extrude(40).intersect(wedge).union(link(4, 9.5, 20, 2.6, -4).translate((5, 0, 0)))
    body = body.cut(W("YZ", origin=(-30, 0, 0)).circle(4.4).extrude(31)).cut(lying(turned((0, -0.01), (5.2, -0.01), (4.4, 0.8), (0, 0.8)), "+x").translate((-26, 0, 0)))
    return body.cut(disc(5.2, 20, -10, 25)).cut(disc(1.1, 20, 0, -2)).cut(W().box(0.6, 2, 3).translate((-12, 0, 6)))


@part(turn=True, offset=1.0)
def circlip():
    body = disc(17, 1.5).cut(disc(14.2, 4, -1, 0.7))
    body = joined(body, [disc(3, 1.5, 0, 16.2, y) for y in (-4.6, 4.6)])
    body = body.edges("|Z").edges(inside((12, -9, 0), (18, 9, 2))).fillet(0.9)
    body = body.cut(W().box(20, 3.8, 8).translate((20, 0, 0)))
    return less(body, [disc(1.2, 5, -1, 16.4, y) for y in (-4.8, 4.8)])
