"""The parts, by family; those of the second series in `second/`, of the third in `third/`, of the fourth in `fourth/`,
of the fifth in `fifth/`, of the sixth in `sixth/`."""
from . import electrical, fifth, free_forms, fourth, gears, housings, second, sixth, third, turned_parts
from .register import SERIES

__all__ = ["SERIES", "electrical", "fifth", "free_forms", "fourth", "gears", "housings", "second", "sixth", "third", "turned_parts"]
