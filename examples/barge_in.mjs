// Tells a story until the user barges in, finishes the current word, and prints what was heard.

const ADDRESS = 'http://127.0.0.1:8088';
const BML = `
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="talk">
  <speech id="words"><text>It is a long story, and nobody has ever heard the end of it.</text></speech>
</bml>
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmla="http://www.asap-project.org/bmla" id="yield">
  <bmla:interrupt id="stop" target="talk" speech="word" start="anticipators:user:barges_in"/>
  <head id="nod" lexeme="NOD" start="stop:start"/>
</bml>`;

const socket = new WebSocket(`${ADDRESS.replace('http', 'ws')}/ws?streams=feedback`);
const send = (message) => socket.send(JSON.stringify(message));

socket.addEventListener('open', () => {
  // Withdraw the prediction of an earlier run.
  send({ type: 'predict', anticipator: 'user', sync: 'barges_in', time: null });
  send({ type: 'bml', xml: BML, ref: 'story' });
});

socket.addEventListener('message', ({ data }) => {
  const { type, xml, message } = JSON.parse(data);
  if (type === 'error') console.error(message);
  if (type !== 'feedback') return;

  const attribute = (name) => new RegExp(` (?:\\w+:)?${name}="(.*?)"`).exec(xml)?.[1];
  switch (attribute('id')) {
    case 'talk:words:start': // stands in for a voice detector
      setTimeout(() => send({ type: 'predict', anticipator: 'user', sync: 'barges_in', in: 0 }), 1000);
      break;
    case 'talk:words:end':
      console.log(`heard ${attribute('heard')} characters, up to the word '${attribute('text')}'`);
      break;
    case 'yield:end':
      socket.close();
  }
});
