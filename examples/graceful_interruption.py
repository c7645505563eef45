"""Interrupting each behavior at a suitable point (thesis, example 16).

A virtual human explains something with words and a gesture. While she speaks, two continuations are prepared: words
that let the sentence trail off, and a gesture that yields the turn. One more block ties the interruption of each
behavior, and its replacement, to sync points of the playing block, so no message has to arrive in time.

Watch the times: each behavior ends exactly when its replacement begins.
"""

import asyncio

from example_scene import ExampleScene, open_example

EXPLAIN = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="explain">
  <speech id="words"><text>First you take the <sync id="red"/>red one, and after that <sync id="here"/>the blue one goes
    on top of it.</text></speech>
  <gesture id="show" lexeme="OFFER" mode="LEFT_HAND" stroke="words:red"/>
  <head id="nod" lexeme="NOD" repetition="4" start="words:start" end="words:end"/>
</bml>
"""
TRAIL_OFF = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla"
     id="trail_off" bmla:preplan="true">
  <speech id="words"><text>but you were saying?</text></speech>
</bml>
"""
GIVE_WAY = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla"
     id="give_way" bmla:preplan="true">
  <gesture id="please" lexeme="OFFER" mode="LEFT_HAND"/>
  <gaze id="look" target="viewer" start="please:start" end="please:end"/>
</bml>
"""
STOP = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla" id="stop">
  <bmla:interrupt id="rest" target="explain" exclude="words,show"/>
  <bmla:interrupt id="voice" target="explain" include="words" start="explain:words:here"/>
  <bmla:activate id="new_words" target="trail_off" start="explain:words:here"/>
  <bmla:interrupt id="hand" target="explain" include="show" start="explain:show:strokeEnd"/>
  <bmla:activate id="new_hand" target="give_way" start="explain:show:strokeEnd"/>
</bml>
"""

SHOWN = ("explain:*:start", "explain:*:end", "trail_off:words:*", "give_way:*:start", "give_way:*:end")


async def main() -> ExampleScene:
    async with open_example(*SHOWN) as scene:
        scene.perform(EXPLAIN)
        scene.perform(TRAIL_OFF)
        scene.perform(GIVE_WAY)
        await scene.until(0.7)
        scene.log("the user: But")
        scene.perform(STOP)
        await scene.until(8)
        return scene


if __name__ == "__main__":
    asyncio.run(main())
