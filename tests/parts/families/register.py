"""The register of parts: what builds each, which meshes it gets, how it lies and how large it is."""

SERIES = {1: {}, 2: {}}


def part(uniform=True, turn=False, offset=0.0, scale=1.0):
    """Registers a part function with its series: the second for those in `second/`.

    uniform: is it meshed by gmsh too; turn: an arbitrary rotation; offset: of the centre, in diagonals;
    scale: of its size.
    """
    def register(function):
        series = 2 if function.__module__.startswith("families.second.") else 1
        SERIES[series][function.__name__] = (function, uniform, turn, offset, scale)
        return function
    return register
