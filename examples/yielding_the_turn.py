"""Yielding the turn in three ways (thesis, example 10).

A user barges in while the virtual human speaks and gestures. A planner that knows the progress of the gesture from
feedback chooses between:

- before the gesture has begun: interrupt everything;
- after its relax: interrupt the rest, since the hand is already returning;
- in between: interrupt everything, and continue with a gesture that offers the turn.

In each case, the speech may finish its current word (``speech="word"``).

Watch the last word that was heard, and the motion of the hand.
"""

import asyncio

from example_scene import ExampleScene, open_example

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


def way_out(scene: ExampleScene) -> str:
    """The block that suits the progress of the gesture."""
    if not scene.feedback.reached("talk:left:start"):
        return YIELD.format(exclude="", instead="")
    if scene.feedback.reached("talk:left:relax"):
        return YIELD.format(exclude='exclude="left"', instead="")
    return YIELD.format(exclude="", instead=OFFER)


async def barge_in(time: float) -> ExampleScene:
    async with open_example(*SHOWN) as scene:
        print(f"The user barges in at {time:g} s.")
        scene.perform(TALK)
        await scene.until(time)
        scene.perform(way_out(scene))
        await scene.until(12)
        return scene


async def main() -> list[ExampleScene]:
    return [await barge_in(time) for time in (0.8, 3.0, 3.8)]


if __name__ == "__main__":
    asyncio.run(main())
