//! Fisher's exact test, on one side.

/// The probability that, of `of + among` things of which `x + stated` are marked, `of` things that are drawn hold `x`
/// marked ones or more: how probable it is that both parts have one rate, and the drawn one looks this much worse.
pub fn this_many_or_more([x, of]: [u64; 2], [stated, among]: [u64; 2]) -> f64 {
    let (all, marked) = (of + among, x + stated);
    let total = ln_choose(all, of);
    let most = marked.min(of);
    let terms = (x..=most).map(|x| {
        let rest = of - x;
        match rest <= all - marked {
            true => (ln_choose(marked, x) + ln_choose(all - marked, rest) - total).exp(),
            false => 0.0,
        }
    });
    terms.sum::<f64>().min(1.0)
}

/// The logarithm of the number of ways to choose `k` of `n` things.
fn ln_choose(n: u64, k: u64) -> f64 {
    let ln_factorial = |n: u64| libm::lgamma(n as f64 + 1.0);
    ln_factorial(n) - ln_factorial(k) - ln_factorial(n - k)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lady tasting tea (Fisher, 1935): of 4 and 4 cups, 3 or more of 4 right is 17 of 70, and all right 1 of 70.
    #[test]
    fn the_lady_tasting_tea() {
        let three = this_many_or_more([3, 4], [1, 4]);
        assert!((three - 17.0 / 70.0).abs() < 1e-12, "{three}");
        let four = this_many_or_more([4, 4], [0, 4]);
        assert!((four - 1.0 / 70.0).abs() < 1e-12, "{four}");
    }

    #[test]
    fn nothing_drawn_proves_nothing() {
        assert_eq!(this_many_or_more([0, 0], [5, 100]), 1.0);
        assert!((this_many_or_more([0, 1000], [5, 100]) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_rate_ten_times_as_high_is_noticed() {
        assert!(this_many_or_more([50, 1000], [10, 2000]) < 1e-6);
        assert!(this_many_or_more([8, 1000], [10, 2000]) > 0.1);
    }
}
