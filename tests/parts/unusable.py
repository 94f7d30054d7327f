class Unusable(Exception):
    """A part or mesh that does not keep the promises of the format."""
