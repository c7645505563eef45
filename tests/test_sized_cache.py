"""A cache that is limited by the size of its values."""

from reactive_realizer.sized_cache import SizedCache


def test_the_values_that_were_used_longest_ago_make_room_for_new_ones() -> None:
    cache = SizedCache[str, int](10)
    for number, name in enumerate("abc"):
        cache.add(name, number, 3)
    assert cache.get("a") == 0
    cache.add("d", 3, 4)
    assert [cache.get(name) for name in "abcd"] == [0, None, 2, 3]


def test_a_value_that_is_larger_than_the_cache_is_not_kept_and_removes_none() -> None:
    cache = SizedCache[str, int](10)
    cache.add("a", 0, 3)
    cache.add("b", 1, 11)
    assert (cache.get("a"), cache.get("b"), len(cache)) == (0, None, 1)


def test_a_value_that_is_added_again_counts_once() -> None:
    cache = SizedCache[str, int](10)
    for _ in range(5):
        cache.add("a", 0, 3)
    cache.add("b", 1, 7)
    assert len(cache) == 2
