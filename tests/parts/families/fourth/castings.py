"""Cast bodies and covers: ribs, bosses, drafted walls, machined seats."""
from ..register import part
from ..second.outlines import counterbore, inside, lying, rounded_rect
from ..shapes import W, disc, turned, around, joined, less, radial


@part(turn=True, offset=1.0)
def end_shield():
    body = turned((0, 0), (40, 0), (40, 7), (36, 20), (0, 26)).cut(turned((0, -1), (35, -1), (32, 15), (0, 21)))
    ears = [W("XY").center(44, 0).circle(7).extrude(8).union(W().box(10, 14, 8, centered=(False, True, False)).translate((34, 0, 0)))]
    ears = around(ears[0].cut(disc(35.5, 30, -5)), 4)
    hub = turned((0, 14), (16, 14), (16, 32), (15, 33), (0, 33)).cut(turned((0, -5), (11, -5), (11, 27), (6, 27), (6, 40), (0, 40)))
    body = joined(body, ears).cut(disc(12, 30, 5)).union(hub)
    rib = W("XZ").polyline([(14, 15), (33, 9), (33, 14), (14, 18)]).close().extrude(1.5, both=True)
    body = joined(body, [r.rotate((0, 0, 0), (0, 0, 1), 45) for r in around(rib, 4)])
    body = less(body, around(disc(3.2, 40, -10, 45), 4))
    vent = W("XY", origin=(24.5, 0, -1)).slot2D(11, 5).extrude(40)
    return less(body, [v.rotate((0, 0, 0), (0, 0, 1), 22.5) for v in around(vent, 8)])


@part(turn=True)
def anvil():
    body = rounded_rect(60, 44, 6, 10, 8).union(rounded_rect(34, 24, 4, 40)).union(W().box(74, 24, 16, centered=(True, True, False)).translate((4, 0, 32)))
    body = body.edges("%CIRCLE or %LINE").edges(inside((-18, -13, 9.9), (18, 13, 10.1))).fillet(5)
    horn = lying(turned((0, 0), (11, 0), (2, 38), (0, 38)).union(W().sphere(2.0596).translate((0, 0, 37.503))), "-x")
    body = body.union(horn.translate((-33, 0, 37)))
    body = body.cut(W("XZ", origin=(0, 0, 10)).circle(9).extrude(40, both=True).translate((0, 0, -10)))
    body = body.cut(W("XY", origin=(34, 0, 30)).rect(7, 7).extrude(30)).cut(disc(2.5, 40, 25, 24, 6))
    return less(body, [disc(3, 40, -10, x, y) for x in (-24, 24) for y in (-16, 16)])


@part(turn=True, offset=0.5)
def thermostat_cover():
    flange = W().polyline([(-34, 0), (0, -22), (34, 0), (0, 22)]).close().extrude(7).edges("|Z").fillet(9)
    body = flange.union(turned((0, 0), (19, 0), (17, 20), (0, 20)))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 19.9), (1, 1, 20.1))).fillet(6)
    spout = W("YZ", origin=(0, 0, 13)).circle(7.5).extrude(44).union(W("YZ", origin=(38, 0, 13)).circle(8.4).extrude(3))
    spout = spout.rotate((0, 0, 13), (0, 0, 14), 70).cut(W().box(200, 200, 20).translate((0, 0, -10.01)))
    body = body.union(spout).cut(turned((0, -1), (15, -1), (14, 10), (9, 16), (0, 16)))
    bore = W("YZ", origin=(0, 0, 13)).circle(5.5).extrude(60).rotate((0, 0, 13), (0, 0, 14), 70)
    body = body.cut(bore).union(disc(5, 23, 3, -12, -5).cut(disc(14, 30, -12)))
    return less(body, [disc(3, 40, -10, x) for x in (-25, 25)]).cut(disc(2, 40, 10, -12, -5))


@part(turn=True, offset=1.0)
def gearcase_half():
    outline = lambda grow, h, z: disc(30 + grow, h, z).union(disc(20 + grow, h, z, 40)).union(W("XY", origin=(20, 0, z)).polyline(
        [(-16, -27 - grow), (22, -19 - grow), (22, 19 + grow), (-16, 27 + grow)]).close().extrude(h))
    body = outline(0, 26, 0).faces("<Z").edges().fillet(3).union(outline(5, 5, 21)).cut(outline(-4, 40, 4).faces("<Z").edges().fillet(1.5))
    bosses = [disc(11, 12, -4).faces("<Z").edges().chamfer(1.5), disc(8, 12, -4, 40)]
    body = joined(body, bosses).cut(disc(8, 30, -1)).cut(disc(5, 60, -20)).cut(disc(5, 30, 0, 40))
    spots = [radial(32.6, a) for a in (1.6, 2.5, 3.8, 4.7)]
    body = less(body, [disc(1.6, 12, 16, x, y) for x, y in spots] + [disc(1.6, 12, 16, 40 + 22.5 * c, 22.5 * s) for c, s in (radial(1, 0.7), radial(1, -0.7))])
    body = body.union(W().box(6, 50, 8, centered=(True, True, False)).translate((-29, 0, 13)).edges("|Z").fillet(2).cut(outline(-2, 60, -5)))
    return body.cut(disc(2, 30, 10, 22, 0))


@part(turn=True, offset=1.0)
def rail_chair():
    body = W().box(90, 40, 9, centered=(True, True, False)).edges("|Z").fillet(8).faces(">Z").edges().fillet(2.5)
    jaw = W("XZ").polyline([(17, 5), (42, 5), (34, 24), (27, 38), (19, 38), (22, 22), (17, 16)]).close().extrude(12, both=True)
    jaw = jaw.edges("|Y").edges(inside((16, -20, 37), (30, 20, 39))).fillet(2)
    body = body.union(jaw).union(jaw.mirror("YZ"))
    rib = W("XZ").polyline([(30, 8), (41, 8), (29, 30)]).close().extrude(2.5, both=True)
    body = joined(body, [q.translate((0, y, 0)) for q in (rib, rib.mirror("YZ")) for y in (-8, 8)])
    body = body.cut(W("XZ", origin=(0, 0, 9)).circle(4).extrude(40, both=True))
    body = less(body, [W("XZ", origin=(x, 0, 31)).circle(2).extrude(40, both=True) for x in (-24, 24)])
    return less(body, [counterbore(3.5, 6, 2, 30).translate((x, 15, 9)) for x in (-36, 0, 36)] + [disc(3.5, 30, -5, x, -15) for x in (-36, 36)])
