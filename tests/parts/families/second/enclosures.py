"""Enclosures: thin walls, bosses, ribs and vents."""
from ..register import part
from ..shapes import W, disc, turned, joined, less
from .outlines import lying, rounded_rect


@part(turn=True)
def enclosure_lid():
    body = rounded_rect(92, 58, 10, 14).faces(">Z").edges().fillet(5)
    body = body.cut(rounded_rect(88, 54, 8, 12).faces(">Z").edges().fillet(3)).cut(rounded_rect(90, 56, 9, 2))
    posts = [(x, y) for x in (-37, 37) for y in (-20, 20)]
    body = joined(body, [disc(4, 9.5, 3, x, y) for x, y in posts] + [W().box(1.6, 50, 3).translate((x, 0, 11)) for x in (-20, 20)])
    body = less(body, [disc(1.4, 6, 2.5, x, y) for x, y in posts])
    body = body.cut(W("XY", origin=(0, 8, 14.01)).rect(34, 18).extrude(-4, taper=45))
    body = body.cut(W("XY", origin=(0, -14, 10)).rarray(9, 1, 3, 1).circle(3).extrude(10))
    return less(body, [W("YZ", origin=(-50, y, 7)).slot2D(7, 2, 90).extrude(100) for y in (-9, -3, 3, 9)])


@part(turn=True, offset=1.0)
def junction_box():
    body = W().box(74, 54, 40, centered=(True, True, False)).edges("|Z or <Z").fillet(7)
    body = body.cut(W().box(68, 48, 40, centered=(True, True, False)).translate((0, 0, 3)).edges("|Z or <Z").fillet(4))
    spigot = turned((0, -8), (9, -8), (9, 4), (8, 10), (0, 10))
    body = body.union(lying(spigot, "+x").translate((37, 0, 20))).union(lying(spigot, "-x").translate((-37, 0, 20)))
    body = body.union(lying(spigot, "+y").translate((12, 27, 20)))
    body = body.cut(W().box(68, 48, 30, centered=(True, True, False)).translate((0, 0, 6)).edges("|Z").fillet(4))
    body = body.cut(W("YZ", origin=(0, 0, 20)).circle(6).extrude(60, both=True)).cut(W("XZ", origin=(12, 0, 20)).circle(6).extrude(-60))
    posts = [disc(5, 36, 2, x, y) for x in (-30, 30) for y in (-20, 20)]
    body = less(joined(body, posts), [disc(1.8, 20, 20, x, y) for x in (-30, 30) for y in (-20, 20)])
    ear = W().box(16, 26, 4, centered=(True, True, False)).edges("|Z").edges("<Y").fillet(6)
    ears = [ear.translate((x, -32, 7)) for x in (-20, 20)]
    body = joined(body, [e.cut(W().box(68, 48, 60)) for e in ears])
    return less(body, [W("XY", origin=(x, -37, 0)).slot2D(8, 4.5, 90).extrude(20) for x in (-20, 20)])


@part(offset=1.0, scale=1.5)
def cell_tray():
    body = W().box(84, 96, 18, centered=(True, True, False)).edges("|Z").fillet(6).edges(">Z").fillet(2)
    cell = W("XZ", origin=(0, 0, 18)).circle(9).extrude(30, both=True).union(W().sphere(9).translate((0, 30, 18))).union(W().sphere(9).translate((0, -30, 18)))
    body = less(body, [cell.translate((x, 0, 0)) for x in (-30, -10, 10, 30)])
    body = body.cut(W("YZ", origin=(0, 0, 18)).circle(12).extrude(60, both=True))
    body = body.cut(W().box(76, 88, 4, centered=(True, True, False)).translate((0, 0, -0.01)).edges("|Z").fillet(3))
    tubes = [disc(4, 5, 0, x, y) for x in (-20, 20) for y in (-35, 35)]
    return less(joined(body, tubes), [disc(1.5, 30, -1, x, y) for x in (-20, 20) for y in (-35, 35)])
