"""Brackets, supports and forks."""
from ..register import part
from ..second.outlines import counterbore, countersink, inside, link, lying, rounded_rect
from ..shapes import W, disc, turned, less, radial
from .profiles import outline, sector


@part(turn=True, offset=1.0)
def shaft_support():
    profile = outline((-26, 0), (26, 0), (26, 7), (10, 7, 3), (10, 36, 2), (-10, 36, 2), (-10, 7, 3), (-26, 7), plane="XZ")
    body = profile.extrude(8, both=True).cut(W("XZ", origin=(0, 0, 20)).circle(6).extrude(20, both=True)).cut(W().box(1.2, 40, 20).translate((0, 0, 34)))
    body = body.cut(lying(counterbore(2, 3.6, 3, 12), "+x").translate((10, 0, 30))).cut(W("YZ", origin=(-20, 0, 30)).circle(1.6).extrude(20))
    body = less(body, [W("XY", origin=(x, 0, -1)).slot2D(7.5, 4.6).extrude(20) for x in (-19, 19)])
    return body.cut(W().box(22, 40, 2)).cut(disc(1.5, 18, -2))


@part(turn=True)
def rail_clip():
    body = outline((-25, 4, 1), (25, 4, 2), (25, -6, 1), (17.5, -6), (16, -4.2), (17.5, -2.4), (20, -2.4), (20, 0, 0.8), (-20, 0, 0.8), (-20, -2.4), (-17, -2.4),
                   (-20.5, -8, 1), (-31, -8), (-31, -6.4), (-23.4, -6.4, 1), (-23.4, 1, 0.6), (-25, 2.6), plane="XZ").extrude(7, both=True)
    body = body.cut(W("XZ", origin=(-16, 0, 2)).slot2D(12, 1.4).extrude(20, both=True)).union(W().box(16, 14, 3).translate((4, 0, 5)))
    body = less(body, [countersink(1.7, 3.2, 30).translate((x, 0, 6.5)) for x in (0, 9)])
    return body.cut(W("XY", origin=(-29, 0, -20)).slot2D(6, 2, 90).extrude(20))


@part(turn=True, offset=1.0)
def slotted_quadrant():
    plate = sector(8, 56, 0.72, 5).edges("|Z").edges(inside((30, -60, 0), (60, 60, 5))).fillet(5)
    body = plate.union(W().box(26, 24, 5, centered=(False, True, False)).translate((-18, 0, 0))).union(disc(12, 15))
    body = body.union(W().box(6, 46, 30, centered=(False, True, False)).translate((-24, 0, 0)).edges("|X").edges(">Z").fillet(8))
    rib = W("XZ").polyline([(-19, 4), (-6, 4), (-19, 22)]).close().extrude(2, both=True)
    body = body.union(rib).cut(disc(6.5, 40, -5))
    slot = sector(42.8, 49.2, 0.52, 20, -5)
    body = less(body, [slot] + [disc(3.2, 20, -5, *radial(46, a)) for a in (-0.52, 0.52)])
    body = less(body, [lying(countersink(2.4, 4.6, 20), "-x").translate((-24, y, 17)) for y in (-15, 15)])
    return less(body, [W().box(4, 0.6, 1).translate((53.5, 0, 5)).rotate((0, 0, 0), (0, 0, 1), angle) for angle in range(-30, 31, 10)])


@part(turn=True, offset=0.5)
def castor_fork():
    leg = link(15, 9, 54, 4).union(disc(6.5, 5.5, 0, 54)).rotate((0, 0, 0), (1, 0, 0), 90).rotate((0, 0, 0), (0, 1, 0), 72).translate((0, -14, 46))
    body = leg.union(leg.mirror("XZ")).union(W().box(26, 36, 8).translate((0, 0, 48)))
    body = body.cut(W().box(100, 100, 40).translate((0, 0, 72)))
    head = turned((0, 51), (18, 51), (21, 54), (21, 57), (17, 61), (0, 61))
    body = body.union(head).union(rounded_rect(58, 48, 6, 3.5).translate((0, 0, 60.5)))
    body = less(body, [W("XY", origin=(x, y, 50)).slot2D(9, 6.2, 45 if x * y > 0 else -45).extrude(20) for x in (-22, 22) for y in (-17, 17)])
    x, y = radial(54, 1.2566)
    return body.cut(W("XZ", origin=(x, 0, 46 - y)).circle(4).extrude(50, both=True)).cut(disc(4, 60, 30)).cut(turned((0, 58), (7, 58), (7, 70), (0, 70)))
