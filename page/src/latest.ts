/** Asks one question at a time; of those that come meanwhile only the last is asked. */
export class Latest<Q> {
  private busy = false;
  private waiting: { question: Q } | null = null;

  constructor(private readonly answer: (question: Q) => Promise<void>) {}

  ask(question: Q): void {
    this.waiting = { question };
    if (!this.busy) void this.work();
  }

  private async work(): Promise<void> {
    this.busy = true;
    while (this.waiting) {
      const { question } = this.waiting;
      this.waiting = null;
      try {
        await this.answer(question);
      } catch (error) {
        console.warn(error);
      }
    }
    this.busy = false;
  }
}
