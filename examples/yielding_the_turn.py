"""Yielding the turn in three ways (thesis, example 10).

A user barges in while the virtual human speaks and points with a gesture. A planner that knows from feedback how far
she is chooses:

- the gesture has not begun: everything is broken off;
- the gesture is over its relax: the hand is on its way down anyway, and only the rest is broken off;
- between these: everything is broken off, and the hand goes over into one that offers the turn.

Each time she may still finish the word that she is at (``speech="word"``).

Look at the word that was heard last, and at what the hand does.
"""

import asyncio

from stage import Stage, open_stage

TALK = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="talk">
  <speech id="words"><text>You go on to the church, then you turn to the <sync id="left"/>left, and there you see it,
    between the bakery and the bank.</text></speech>
  <gesture id="left" lexeme="OFFER" mode="LEFT_HAND" stroke="words:left"/>
</bml>
"""
YIELD = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla" id="yield">
  <bmla:interrupt id="stop" target="talk" speech="word" {exclude}/>
  {instead}
</bml>
"""
OFFER = '<gesture id="please" lexeme="OFFER" mode="LEFT_HAND" start="stop:start"/>'
SHOWN = (
    "talk:left:start",
    "talk:left:stroke",
    "talk:left:relax",
    "talk:left:end",
    "talk:words:end",
    "yield:please:stroke",
)


def way_out(stage: Stage) -> str:
    """The block that fits how far the gesture is."""
    if not stage.feedback.reached("talk:left:start"):
        return YIELD.format(exclude="", instead="")
    if stage.feedback.reached("talk:left:relax"):
        return YIELD.format(exclude='exclude="left"', instead="")
    return YIELD.format(exclude="", instead=OFFER)


async def barge_in(time: float) -> Stage:
    async with open_stage(*SHOWN) as stage:
        print(f"The user barges in at {time:g} s.")
        stage.perform(TALK)
        await stage.until(time)
        stage.perform(way_out(stage))
        await stage.until(12)
        return stage


async def main() -> list[Stage]:
    return [await barge_in(time) for time in (0.8, 3.0, 3.8)]


if __name__ == "__main__":
    asyncio.run(main())
