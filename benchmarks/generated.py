"""Plays random sessions with each strategy, and counts the laws that they break; the breaches go to stderr."""

import asyncio
import sys
from collections import Counter
from random import Random

from reactive_realizer.testing.random_session import random_session
from reactive_realizer.testing.session_laws import LAWS, examine

_STRATEGIES = ("convex", "embr", "smartbody")

AIMS = {f"{strategy}.broken.{law}": 0.0 for strategy in _STRATEGIES for law in LAWS}


def measure(blocks: int = 1000) -> dict[str, object]:
    """For each strategy, the number of blocks that were sent, and how often each law was broken.

    Args:
        blocks: least number for each strategy; 1 000 take about 20 s on an idle core.
    """
    return {strategy: _play(strategy, blocks) for strategy in _STRATEGIES}


def _play(strategy: str, blocks: int) -> dict[str, object]:
    sent = seed = 0
    broken = Counter(dict.fromkeys(LAWS, 0))
    while sent < blocks:
        session = random_session(Random(seed))
        for breach in asyncio.run(examine(session, strategy)).breaches:
            broken[breach.law] += 1
            sys.stderr.write(f"{strategy}, seed {seed}, {breach.time:g} s: {breach.law}: {breach.text}\n")
        sent += session.blocks
        seed += 1
    return {"blocks": sent, "broken": dict(broken)}
