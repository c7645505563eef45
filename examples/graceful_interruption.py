"""Breaking off with grace, and at once (thesis, example 16).

A virtual human explains, with words and a hand. How she would stop is prepared while she speaks: some words that let
the sentence trail off, and a hand that gives way. One more block says where each part is to be cut, and what is to go
on in its place, by sync points of what plays: so nothing has to arrive in time, and nothing is between the parts.

Look at the times: each part ends, and what goes on in its place begins, at the same moment.
"""

import asyncio

from stage import Stage, open_stage

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


async def main() -> Stage:
    async with open_stage(*SHOWN) as stage:
        stage.perform(EXPLAIN)
        stage.perform(TRAIL_OFF)
        stage.perform(GIVE_WAY)
        await stage.until(0.7)
        stage.tell("the user: But")
        stage.perform(STOP)
        await stage.until(8)
        return stage


if __name__ == "__main__":
    asyncio.run(main())
