"""Keeping the turn by raising the voice (thesis, example 9).

A user starts to talk while the virtual human is speaking. She keeps the turn: from her next important word on, her
voice gets louder, linearly over half a second. When the user gives up, it returns to normal, with ease-in and
ease-out. The speech continues throughout: a parameter change is a behavior, and can be tied to the behavior it changes.

Watch the bars: they show the volume of the voice; 50 is the recorded volume.
"""

import asyncio

from example_scene import ExampleScene, open_example

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


def volume(scene: ExampleScene) -> float:
    """The current volume, from the last change of the gain."""
    gains = [each.gain for each in scene.sounds if isinstance(each, AudioGain)]
    return 50.0 * gains[-1] if gains else 50.0


async def listen(scene: ExampleScene, until: float) -> None:
    while scene.now < until:
        await scene.advance(0.2)
        scene.log(f"{volume(scene):3.0f} {'#' * round(volume(scene) / 3)}")


async def main() -> ExampleScene:
    async with open_example("*:start", "*:end", "*:important", voice="espeak") as scene:
        scene.perform(TALK)
        await listen(scene, 1.2)
        scene.log("the user: But what about")
        scene.perform(LOUDER)
        await listen(scene, 3.4)
        scene.log("the user is silent")
        scene.perform(AS_BEFORE)
        await listen(scene, 5.0)
        await scene.until(12)
        return scene


if __name__ == "__main__":
    asyncio.run(main())
