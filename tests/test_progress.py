"""Long work tells how far it is, and only to those who ask."""

from lipdb.progress import reported, steps


def test_every_step_is_reported_once_it_is_done() -> None:
    seen: list[tuple[str, int, int]] = []
    with reported(lambda *told: seen.append(told)):
        for item in steps("abc", total=3, what="drawing"):
            assert len(seen) == "abc".index(item)
    assert seen == [("drawing", 1, 3), ("drawing", 2, 3), ("drawing", 3, 3)]


def test_nobody_is_told_outside_the_block() -> None:
    seen: list[tuple[str, int, int]] = []
    with reported(lambda *told: seen.append(told)):
        pass
    assert list(steps("ab", total=2, what="drawing")) == ["a", "b"]
    assert seen == []
