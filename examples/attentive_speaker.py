"""An attentive speaker (thesis, 10.3.7 and 10.4): she goes on when the listener has finished a response.

A virtual human describes a way in six utterances, which are prepared beforehand. Each one activates the next when it
ends, and starts when the listener's response is over. A person who hears the listener (the wizard, in a Wizard of Oz
experiment) presses the space bar while the listener speaks, and releases it at the end of the response. A response
that is over before an utterance has ended does not count for the next one.

Watch the last column: whenever the release comes, the utterance starts with it.
"""

import asyncio
from typing import NamedTuple

from example_scene import ExampleScene, open_example

ROUTE = (
    "Leave the station by the main door, and walk straight ahead to the <sync id='here'/>bridge.",
    "Do not cross it, but turn left and follow the river to the old <sync id='here'/>mill.",
    "Behind the mill there is a path that goes up the <sync id='here'/>hill.",
    "At the top you see a church with a green roof, and a small <sync id='here'/>market.",
    "Go through the market and take the second street on the <sync id='here'/>right.",
    "The house is at the end of that street, with a red <sync id='here'/>door.",
)
UTTERANCE = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla"
     id="part{number}" bmla:preplan="true">
  <speech id="words" start="anticipators:spacebar:release"><text>{text}</text></speech>
  <gesture id="beat" lexeme="BEAT" stroke="words:here"/>
  {following}
</bml>
"""
FOLLOWING = '<bmla:activate id="go_on" target="part{number}" start="words:end"/>'
BEGIN = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla" id="begin">
  <bmla:activate id="now" target="part1"/>
</bml>
"""


class Response(NamedTuple):
    """Words of the listener, from and until a time (s) after the end of an utterance."""

    text: str
    start: float
    end: float


RESPONSES = (
    (Response("Yes, I am ready.", 0.3, 1.2),),
    (Response("Uh-huh.", 0.2, 0.53),),
    (Response("The mill, yes, I know it.", -0.6, 0.9),),
    (Response("Mm.", -1.1, -0.8), Response("Is it steep? I hope not.", 0.4, 1.87)),
    (Response("Okay.", -0.1, 0.02),),
    (Response("The second one.", 0.35, 1.04),),
)
"""The responses before each utterance."""


async def listen(scene: ExampleScene, responses: tuple[Response, ...], end: float) -> float:
    """Have the listener speak around the end of an utterance (s); the time of the last release."""
    for response in responses:
        await scene.until(end + response.start)
        scene.event("spacebar", "press")
        scene.log(f"the listener: {response.text}")
        await scene.until(end + response.end)
        scene.event("spacebar", "release")
    return scene.now


async def main() -> tuple[ExampleScene, list[float]]:
    async with open_example("*:words:start", "*:words:end", "*:beat:stroke") as scene:
        for number, text in enumerate(ROUTE, 1):
            following = FOLLOWING.format(number=number + 1) if number < len(ROUTE) else ""
            scene.perform(UTTERANCE.format(number=number, text=text, following=following))
        await scene.until(0.5)
        scene.perform(BEGIN)
        end, releases = 0.5, []
        for number, responses in enumerate(RESPONSES, 1):
            releases.append(await listen(scene, responses, end))
            await scene.advance(0.1)
            end = scene.feedback.predicted(f"part{number}:words:end")
        await scene.until(end + 2)
        print("part  release  starts")
        for number, release in enumerate(releases, 1):
            print(f"{number:4} {release:8.2f} {scene.feedback.time(f'part{number}:words:start'):7.2f}")
        return scene, releases


if __name__ == "__main__":
    asyncio.run(main())
