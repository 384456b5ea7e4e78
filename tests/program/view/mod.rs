//! `urdd view` as its page and others use it: who is refused, what is served, what saving skips does.

mod asking;
mod dropping;
mod exporting;
mod following;
mod keeping;
mod living;
mod refusing;
mod saving;
mod served;
mod site;
