"""From poses to a character's own shapes: each pose's weight bent, scaled, summed or the largest."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lipdb.curves.keys import Keys
from lipdb.curves.through import Link
from lipdb.track import Track


def identity_links(poses: Sequence[str]) -> tuple[Link, ...]:
    """One link a pose, to the shape of its own name."""
    return tuple(Link(pose, pose, 1.0, "sum", ()) for pose in poses)


def through_links(track: Track, links: Sequence[Link]) -> Track:
    """The weights of the shapes that *links* lead to, 0..1, in the order in which the links first name them.

    A pose's weight goes through the link's curve (straight lines between keys; the first and last key hold), times its
    gain. The sum of a shape's ``sum`` links and each of its ``max`` links: the largest counts. Poses that the track
    lacks weigh 0. The same rule carries curves over to other pose sets (`lipdb.curves.through`).
    """
    shapes = tuple(dict.fromkeys(link.shape for link in links))
    sums = np.zeros((len(track.weights), len(shapes)))
    largest = np.zeros_like(sums)
    for link in links:
        column = shapes.index(link.shape)
        given = track.pose(link.pose) if link.pose in track.poses else np.zeros(len(track.weights))
        weight = link.gain * bent(given, link.curve)
        if link.combine == "max":
            np.maximum(largest[:, column], weight, out=largest[:, column])
        else:
            sums[:, column] += weight
    return Track(np.clip(np.maximum(sums, largest), 0.0, 1.0), shapes, track.fps)


def bent(weights: NDArray[np.float64], curve: Keys) -> NDArray[np.float64]:
    """*weights* of a pose, sent through the *curve* of a link; without keys they stay."""
    if not curve:
        return weights
    at, value = np.array(curve).T
    return np.asarray(np.interp(weights, at, value))


def closing_shapes(links: Sequence[Link], must_reach: Sequence[str]) -> tuple[str, ...]:
    """The shapes that close the mouth: those that a pose of *must_reach* drives by half or more."""
    strong = (link.shape for link in links if link.pose in must_reach and link.gain >= 0.5)
    return tuple(dict.fromkeys(strong))
