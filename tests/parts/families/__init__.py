"""The parts, by family; those of the second series in `second/`."""
from . import electrical, free_forms, gears, housings, second, turned_parts
from .register import SERIES

__all__ = ["SERIES", "electrical", "free_forms", "gears", "housings", "second", "turned_parts"]
