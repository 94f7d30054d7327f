"""Electrical parts: many small and alike features."""
import cadquery as cq

from ..register import part
from ..shapes import W, disc, turned, around, joined, less
from .outlines import inside, lying, rounded_rect


@part(turn=True, offset=1.0)
def terminal_block():
    side = W("YZ").polyline([(-6, 0), (6, 0), (6, 9), (4, 9), (4, 15), (-2.5, 15), (-2.5, 11), (-6, 9)]).close().extrude(20).translate((-10, 0, 0))
    body = side.edges("|X").edges(">Z").fillet(0.8)
    xs = (-7.5, -2.5, 2.5, 7.5)
    body = less(body, [lying(turned((0, -7), (1.2, -7), (1.2, -2), (1.8, -1), (1.8, 0.01), (0, 0.01)), "+y").translate((x, -6, 4.5)) for x in xs])
    body = less(body, [disc(1.7, 12, 6.5, x, 0.8) for x in xs])
    screws = [disc(1.7, 2, 6.4, x, 0.8).cut(W().box(0.5, 4, 1.6).translate((x, 0.8, 8.2))).edges(">Z").edges("%CIRCLE").chamfer(0.15) for x in xs]
    body = joined(body, screws + [W("XY", origin=(x, 2, -3.5)).rect(0.8, 0.8).extrude(4).edges("<Z").chamfer(0.2) for x in xs])
    rib = W("XY", origin=(10, 2, 0)).polyline([(0, -1), (0.8, -1.4), (0.8, 1.4), (0, 1)]).close().extrude(8)
    return body.union(rib).cut(rib.translate((-20, 0, 0)))


@part(turn=True)
def coil_bobbin():
    body = rounded_rect(18, 14, 4, 26)
    flange = rounded_rect(34, 30, 5, 2)
    body = body.union(flange).union(flange.translate((0, 0, 24)))
    body = body.edges(inside((-12, -10, 1.9), (12, 10, 2.1)) + inside((-12, -10, 23.9), (12, 10, 24.1))).edges().fillet(1)
    body = body.cut(W().box(12, 8, 80)).union(W().box(34, 5, 4).translate((0, -14, -2))).union(W().box(34, 5, 4).translate((0, 14, -2)))
    pins = [disc(0.5, 7, -9, x, y).faces("<Z").edges().chamfer(0.2) for x in (-13, -4.5, 4.5, 13) for y in (-14, 14)]
    body = joined(body, pins)
    return less(body, [W("XY", origin=(x, y, 20)).slot2D(6, 2, 90).extrude(10) for x in (-9, 9) for y in (-14.5, 14.5)])


@part(turn=True, offset=1.0)
def round_connector():
    body = W().box(26, 26, 3, centered=(True, True, False)).edges("|Z").fillet(4)
    shell = turned((8, 1), (10.5, 1), (10.5, 3), (10, 3), (10, 15), (9.5, 15.5), (8.4, 15.5), (8, 15.1))
    body = body.union(shell).union(turned((0, -8), (8.5, -8), (9.5, -7), (9.5, 0.5), (0, 0.5)))
    body = body.edges(inside((-0.1, -0.1, 2.9), (0.1, 0.1, 3.1))).edges(cq.selectors.RadiusNthSelector(-1)).fillet(0.7)
    body = body.cut(turned((0, 1.5), (8, 1.5), (8, 9), (0, 9))).union(disc(6.6, 6, 1))
    body = less(body, around(W("YZ", origin=(6, 0, 11)).circle(1.2).extrude(10), 3)).union(W().box(2, 3, 8).translate((0, 7, 5)))
    pin = lambda x, y: disc(0.7, 7, 6, x, y).faces(">Z").edges().fillet(0.4)
    pins = [pin(0, 0)] + around(pin(4, 0), 6)
    tails = [disc(0.9, 5, -12)] + around(disc(0.9, 5, -12, 4), 6)
    body = joined(body, pins + tails)
    return less(body, [disc(1.6, 20, -10, x, y) for x in (-9.5, 9.5) for y in (-9.5, 9.5)])
