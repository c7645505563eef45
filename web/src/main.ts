import { sentenceOf } from "./errors";
import { stateOf } from "./hooks";
import { StatusPanel } from "./panels/status";
import { makeTabs } from "./panels/tabs";
import { qualityOf } from "./quality";
import { Viewer } from "./viewer";

const STREAMS = "feedback,audio,frames,board";

function socketAddress(): URL {
  const address = new URL("ws", document.baseURI);
  address.protocol = address.protocol.replace("http", "ws");
  address.search = new URLSearchParams({ streams: STREAMS }).toString();
  return address;
}

makeTabs(["feedback-tab", "pegs-tab"]);
const status = new StatusPanel();
try {
  const viewer = new Viewer(socketAddress(), qualityOf(location.href), status);
  window.viewer = stateOf(viewer);
  viewer.start();
} catch (error) {
  // Most likely the browser has no WebGL 2.
  status.failed(sentenceOf(error));
  throw error;
}
