"""What hangs together."""

import numpy as np


def labels(count: int, pairs: np.ndarray) -> np.ndarray:
    """(count,) of each thing the least number among those that pairs (k, 2) connect it with.

    Minima run along pairs and are then followed to their ends, until nothing changes: some
    logarithm of the longest way.
    """
    found = np.arange(count)
    first, second = pairs[:, 0], pairs[:, 1]
    while len(pairs):
        least = np.minimum(found[first], found[second])
        before = found.copy()
        for ends in (first, second):
            np.minimum.at(found, ends, least)
            np.minimum.at(found, before[ends], least)
        while True:
            further = found[found]
            if (further == found).all():
                break
            found = further
        if (found == before).all():
            break
    return found
