// The live frames of the server that the page came from. Connects again by itself.

import { decodeFrame } from './frame.js';

const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 2000;
const HIDDEN_MS = 500;

export class Connection {
  // Before it connects, `prepare()` loads what the frames need. Then `onFrame(frame)` and `onState(isConnected)`. Each
  // frame is acknowledged once the page has shown it, so that a slow page gets fewer of them instead of late ones.
  constructor(prepare, onFrame, onState) {
    this.prepare = prepare;
    this.onFrame = onFrame;
    this.onState = onState;
    this.wait = FIRST_WAIT_MS;
    this.connect();
  }

  connectLater() {
    this.onState(false);
    setTimeout(() => this.connect(), this.wait);
    this.wait = Math.min(2 * this.wait, LONGEST_WAIT_MS);
  }

  async connect() {
    try {
      await this.prepare();
    } catch {
      this.connectLater();
      return;
    }
    const socket = new WebSocket(`ws://${location.host}/live`);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.wait = FIRST_WAIT_MS;
      this.onState(true);
    };
    socket.onmessage = (event) => {
      this.onFrame(decodeFrame(event.data));
      let isShown = false;
      const acknowledge = () => {
        if (!isShown && socket.readyState === WebSocket.OPEN) socket.send('shown');
        isShown = true;
      };
      requestAnimationFrame(acknowledge);
      setTimeout(acknowledge, HIDDEN_MS); // a hidden page draws nothing, but goes on listening
    };
    socket.onclose = () => this.connectLater();
  }
}
