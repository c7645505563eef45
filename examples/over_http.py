"""Sends a block, moves a prediction and reads feedback over HTTP, using only the standard library."""

import json
from urllib.request import Request, urlopen

ADDRESS = "http://127.0.0.1:8088"
BML = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="wave">
  <gesture id="hello" lexeme="GREET" stroke="anticipators:door:opens"/>
</bml>
"""


def post(path: str, body: str, content_type: str) -> object:
    request = Request(ADDRESS + path, body.encode(), {"Content-Type": content_type})
    with urlopen(request) as answer:
        return json.load(answer)


with urlopen(f"{ADDRESS}/feedback") as feedback:
    print(post("/predict", json.dumps({"anticipator": "door", "sync": "opens", "in": 1.5}), "application/json"))
    print(post("/bml", BML, "application/xml"))
    for line in feedback:
        if line.startswith(b"data:"):
            xml = json.loads(line.removeprefix(b"data:"))["xml"]
            if "Progress" in xml:
                print(xml)
            if 'id="wave:end"' in xml:
                break
