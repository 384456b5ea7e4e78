/** Runs one query at a time. Of those that arrive meanwhile, only the last one runs. */
export class Latest<Q> {
  private busy = false;
  private working: Promise<void> = Promise.resolve();
  private waiting: { question: Q } | null = null;

  constructor(private readonly answer: (question: Q) => Promise<void>) {}

  ask(question: Q): void {
    void this.done(question);
  }

  /** Answered once this question is, or a later one in its place. */
  done(question: Q): Promise<void> {
    this.waiting = { question };
    if (!this.busy) this.working = this.work();
    return this.working;
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
