"""Valve bodies, couplings and what carries oil, air and water."""
import cadquery as cq

from ..fifth.profiles import round_body
from ..register import part
from ..second.outlines import counterbore, link, lying, nearest
from ..shapes import W, disc, turned, around, joined, less


@part(turn=True, offset=1.0)
def butterfly_valve_body():
    ring = turned((28, -15), (46, -15), (46, 15), (28, 15)).edges("%CIRCLE").edges(cq.selectors.RadiusNthSelector(-1)).chamfer(1)
    body = ring.union(W("XZ", origin=(0, 38, 0)).circle(11).extrude(-44)).edges(nearest((0, 45, 11))).fillet(3)
    body = body.union(W("XZ", origin=(0, 76, 0)).rect(50, 50).extrude(-7).edges("|Y").fillet(10)).union(W("XZ", origin=(0, -38, 0)).circle(9).extrude(16))
    lugs = [q.rotate((0, 0, 0), (0, 0, 1), 45) for q in around(disc(9, 28, -14, 50), 4)]
    body = joined(body, lugs).cut(disc(28, 60, -30)).cut(turned((27, -5), (30, -4), (30, 4), (27, 5)))
    body = body.cut(W("XZ", origin=(0, 100, 0)).circle(5).extrude(150)).cut(W("XZ", origin=(0, 83.01, 0)).circle(7).extrude(9))
    body = less(body, [W("XZ", origin=(x, 90, z)).circle(2.4).extrude(20) for x in (-18, 18) for z in (-18, 18)])
    return less(body, [q.rotate((0, 0, 0), (0, 0, 1), 45) for q in around(disc(4.2, 60, -30, 50), 4)])


@part(turn=True, offset=0.5)
def needle_valve_body():
    body = W().box(62, 24, 24).edges("|X").chamfer(2.5).faces("<X or >X").edges().chamfer(0.8)
    thread = [q for k in range(5) for q in ((8.4, 17 + 1.8 * k), (9.2, 17.6 + 1.8 * k), (9.2, 18 + 1.8 * k), (8.4, 18.6 + 1.8 * k))]
    body = body.union(turned((0, 11), (11, 11), (11, 16), (8.4, 16), *thread, (8.4, 27), (0, 27)))
    body = body.cut(lying(turned((0, -24), (2, -24), (2, -15), (7, -14), (7.8, 0.01), (0, 0.01)), "+x").translate((31, 0, 4)))
    body = body.cut(lying(turned((0, -32), (2, -32), (2, -15), (7, -14), (7.8, 0.01), (0, 0.01)), "-x").translate((-31, 0, -5)))
    body = body.cut(turned((0, -6.5), (2, -6.5), (2, -1), (4.6, 4), (4.6, 20), (6.4, 22), (6.4, 28), (0, 28)))
    return less(body, [W("XZ", origin=(x, 0, z)).circle(2.2).extrude(20, both=True) for x, z in ((-18, 7), (18, -7))])


@part(turn=True, offset=1.0)
def camlock_coupler():
    tail = [(14.4, 0)] + [q for k in range(5) for q in ((14.4, 2 + 8 * k), (16, 7.4 + 8 * k), (16, 8.4 + 8 * k))] + [(14.4, 44), (14.4, 48)]
    body = turned((0, 0), *tail, (24, 54), (26, 56), (26, 90), (24.5, 92), (0, 92))
    lugs = [W().box(12, 3.4, 22).edges("|Y").edges(">X").fillet(5).translate((29, y, 76)) for y in (-7.5, 7.5)]
    body = joined(body, [q.rotate((0, 0, 0), (0, 0, 1), angle) for q in lugs for angle in (0, 180)])
    body = body.cut(turned((0, -1), (12, -1), (12, 50), (20, 58), (20, 62), (21.5, 63.5), (21.5, 84), (22.5, 93), (0, 93)))
    body = less(body, [W().box(12, 11.2, 14).translate((s * 24, 0, 76)) for s in (-1, 1)])
    arm = link(6.4, 3.4, 46, 11).rotate((0, 0, 0), (1, 0, 0), 90).rotate((0, 0, 0), (0, 1, 0), 82).translate((29, 5.5, 76))
    arm = arm.cut(W("XZ", origin=(36, 0, 34)).circle(2.4).extrude(20, both=True)).cut(turned((0, 0), (21, 0), (21, 90), (0, 90)))
    pin = W("XZ", origin=(30, 10.4, 76)).circle(2).extrude(20.8)
    return joined(body, [q.rotate((0, 0, 0), (0, 0, 1), angle) for q in (arm, pin) for angle in (0, 180)])


@part(turn=True, offset=1.0)
def hydraulic_subplate():
    body = W().box(104, 72, 32, centered=(True, True, False)).edges("|Z").fillet(3).faces("<Z or >Z").edges().chamfer(1)
    ports = [(0, 14), (0, -14), (-16, 0), (16, 0)]
    body = less(body, [turned((0, 12), (4.2, 12), (4.2, 30.4), (7, 30.4), (7, 33), (0, 33)).translate((x, y, 0)) for x, y in ports])
    body = less(body, [turned((0, 16), (2.5, 16), (2.5, 31.4), (3.1, 32.01), (0, 32.01)).translate((x, y, 0)) for x in (-24, 24) for y in (-16.5, 16.5)])
    body = less(body, [counterbore(4.3, 7, 7, 50).translate((x, y, 32)) for x in (-42, 42) for y in (-26, 26)])
    side = turned((0, -60), (4.2, -60), (4.2, -16), (8, -14), (8, -2), (9.5, -0.5), (9.5, 0.01), (0, 0.01))
    short = side.intersect(turned((0, -38), (20, -38), (20, 1), (0, 1)))
    body = less(body, [lying(short, "+x").translate((52, 0, 16)), lying(short, "-x").translate((-52, 0, 16))])
    short = side.intersect(turned((0, -24), (20, -24), (20, 1), (0, 1)))
    body = less(body, [lying(short, "+y").translate((0, 36, 14)), lying(short, "-y").translate((0, -36, 14))])
    return less(body, [disc(2, 6, 28, 30, 0), disc(1.6, 9, -1, -30, -30), disc(1.6, 9, -1, 30, 30)])


@part(turn=True)
def air_regulator_body():
    body = W().box(44, 44, 36, centered=(True, True, False)).edges("|Z").fillet(8).union(round_body((0, 34), (24, 34), (24, 41, 2), (19, 43, 2), (16, 62, 3), (0, 66)))
    body = joined(body, around(W().box(3, 3, 17).translate((17, 0, 52)).edges("|Z").edges(">X").fillet(1), 12))
    body = body.union(round_body((0, 1), (18, 1), (18, -6, 1), (14, -26, 6), (0, -26)))
    ports = [lying(W("XY").polygon(6, 26).extrude(9), axis).translate((x, 0, 18)) for axis, x in (("+x", 20), ("-x", -20))]
    body = joined(body, ports)
    port = turned((0, -22), (4, -22), (4, -14), (6.4, -13), (6.9, 0.01), (0, 0.01))
    body = less(body, [lying(port, "+x").translate((29, 0, 18)), lying(port, "-x").translate((-29, 0, 18)), lying(port, "-y").translate((0, -22, 18))])
    body = body.cut(turned((0, -27), (3, -27), (3, -20), (9, -14), (14, -6), (14, 6), (5, 8), (5, 12), (0, 12)))
    return less(body, [disc(2.2, 60, -5, x, y) for x in (-17, 17) for y in (-17, 17)])


@part(turn=True, offset=1.0)
def pipe_union():
    nut = W("XY").polygon(6, 58).extrude(20).intersect(turned((0, 0), (26, 0), (29.5, 3.5), (29.5, 16.5), (26, 20), (0, 20)))
    lower = W("XY", origin=(0, 0, -30)).polygon(8, 42).extrude(18).edges("|Z").chamfer(1)
    body = nut.union(lower).union(turned((0, -14), (22, -14), (22, 1), (0, 1))).union(round_body((0, 18), (21, 18), (21, 24, 2), (17, 26, 2), (17, 46, 0.8), (0, 46)))
    body = body.cut(turned((0, -31), (13.4, -31), (12.2, -14), (10, -12), (10, 24), (11.8, 26), (13.2, 47), (0, 47)))
    return body.union(W("YZ", origin=(16, 0, 36)).circle(3).extrude(3)).cut(turned((22, 0), (40, 0), (40, 0.6), (22, 0.6)))
