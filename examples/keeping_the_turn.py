"""Keeping the turn by speaking up (thesis, example 9).

A user starts to talk while the virtual human does. She keeps the turn: from her next important word on her voice gets
louder, along a line of half a second; when the user gives up, it goes back, slowly at both ends. The speech goes on all
the while: a change of a parameter is a behavior of its own, which may be tied to the one that it changes.

Look at the bars: how loud the voice is, 50 being as it was recorded.
"""

import asyncio

from stage import Stage, open_stage

from reactive_realizer.embodiment.audio import AudioGain

TALK = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="talk">
  <speech id="words"><text>The museum is closed on Mondays, but on <sync id="important"/>Tuesdays it opens at nine,
    and you can stay there until it gets dark, or until you are hungry.</text></speech>
</bml>
"""
LOUDER = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla" id="louder">
  <bmla:parametervaluechange id="up" target="talk:words" paramId="volume"
      start="talk:words:important" end="talk:words:important+0.5">
    <bmla:trajectory type="linear" targetValue="90"/>
  </bmla:parametervaluechange>
</bml>
"""
AS_BEFORE = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla" id="as_before">
  <bmla:parametervaluechange id="down" target="talk:words" paramId="volume" start="0" end="1">
    <bmla:trajectory type="ease-in-ease-out" targetValue="50"/>
  </bmla:parametervaluechange>
</bml>
"""


def volume(stage: Stage) -> float:
    """How loud it is now, as the loudspeaker was told last."""
    gains = [each.gain for each in stage.sounds if isinstance(each, AudioGain)]
    return 50.0 * gains[-1] if gains else 50.0


async def listen(stage: Stage, until: float) -> None:
    while stage.now < until:
        await stage.advance(0.2)
        stage.tell(f"{volume(stage):3.0f} {'#' * round(volume(stage) / 3)}")


async def main() -> Stage:
    async with open_stage("*:start", "*:end", "*:important", voice="espeak") as stage:
        stage.perform(TALK)
        await listen(stage, 1.2)
        stage.tell("the user: But what about")
        stage.perform(LOUDER)
        await listen(stage, 3.4)
        stage.tell("the user is silent")
        stage.perform(AS_BEFORE)
        await listen(stage, 5.0)
        await stage.until(12)
        return stage


if __name__ == "__main__":
    asyncio.run(main())
