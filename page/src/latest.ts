/** Runs one query at a time. Of those that arrive meanwhile, only the last one runs. */
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
