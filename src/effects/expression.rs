//! Reads an expression as it would be read on paper, and hands it to `exmex` for evaluation.
//!
//! ```text
//! sum    := product (('+' | '-') product)*            left to right
//! product := signed (('*' | '/') signed)*             left to right
//! signed := ('-' | '+') signed | power                −2^2 = −(2^2)
//! power  := atom ('^' exponent)?                      2^3^2 = 2^(3^2), 2^−1
//! exponent := ('-' | '+') exponent | power
//! atom   := number | name | name '(' sum (',' sum)* ')' | '(' sum ')'
//! ```
//! `exmex` itself binds a sign closer than a power and reads powers from the left. So it is given the expression with every
//! pair of parentheses written out, which leaves it nothing to decide. Names are looked up here, with their places.

use std::fmt;

use exmex::prelude::*;
use exmex::{BinOp, FlatEx, MakeOperators, Operator, ops_factory};

use super::error::nearest;

/// Functions a formula may call: name, number of arguments, meaning.
pub const FUNCTIONS: &[(&str, usize, &str)] = &[
    ("exp", 1, "e to the power of x"),
    ("ln", 1, "natural logarithm"),
    ("log10", 1, "logarithm to base 10"),
    ("sqrt", 1, "square root"),
    ("abs", 1, "absolute value"),
    ("sin", 1, "sine of x rad"),
    ("cos", 1, "cosine of x rad"),
    ("tan", 1, "tangent of x rad"),
    ("tanh", 1, "hyperbolic tangent"),
    ("step", 1, "1 for x above 0, else 0"),
    ("min", 2, "the smaller one"),
    ("max", 2, "the larger one"),
];

/// Longest expression, characters.
const LONGEST: usize = 4000;
/// Deepest nesting.
const DEEPEST: usize = 60;

const fn left(apply: fn(f64, f64) -> f64) -> BinOp<f64> {
    BinOp {
        apply,
        prio: 0,
        is_commutative: false,
    }
}

ops_factory!(
    Operators,
    f64,
    Operator::make_bin("^", left(f64::powf)),
    Operator::make_bin("*", left(|a, b| a * b)),
    Operator::make_bin("/", left(|a, b| a / b)),
    Operator::make_bin("+", left(|a, b| a + b)),
    Operator::make_bin_unary("-", left(|a, b| a - b), |a| -a),
    Operator::make_bin("min", left(f64::min)),
    Operator::make_bin("max", left(f64::max)),
    Operator::make_unary("exp", f64::exp),
    Operator::make_unary("ln", f64::ln),
    Operator::make_unary("log10", f64::log10),
    Operator::make_unary("sqrt", f64::sqrt),
    Operator::make_unary("abs", f64::abs),
    Operator::make_unary("sin", f64::sin),
    Operator::make_unary("cos", f64::cos),
    Operator::make_unary("tan", f64::tan),
    Operator::make_unary("tanh", f64::tanh),
    Operator::make_unary("step", |x| if x > 0.0 { 1.0 } else { 0.0 })
);

/// A compiled expression.
#[derive(Debug, Clone)]
pub(super) struct Expression {
    tree: FlatEx<f64, Operators>,
}

impl Expression {
    /// Reads `text`; `known` tells whether a name stands for a number, else why not.
    pub(super) fn parse(
        text: &str,
        known: &dyn Fn(&str) -> Result<(), String>,
    ) -> Result<Self, ExpressionError> {
        let mut reader = Reader {
            text,
            tokens: tokens(text)?,
            next: 0,
            depth: 0,
            known,
        };
        let written = reader.sum()?;
        if let Some(extra) = reader.peek() {
            let message = match extra.kind {
                Kind::Sign(')') => "this parenthesis was never opened".to_owned(),
                Kind::Sign(_) => "this cannot stand here".to_owned(),
                _ => "an operator is missing before this".to_owned(),
            };
            return Err(reader.fault(extra, message));
        }
        let tree = FlatEx::parse(&written).map_err(|error| ExpressionError {
            text: text.to_owned(),
            column: 0,
            length: text.chars().count(),
            message: format!("cannot be evaluated: {error}"),
        })?;
        Ok(Self { tree })
    }

    /// The names it uses, in the order in which [`Expression::evaluate`] takes their values.
    pub(super) fn names(&self) -> &[String] {
        self.tree.var_names()
    }

    /// Its value; NaN if the number of values is wrong.
    pub(super) fn evaluate(&self, values: &[f64]) -> f64 {
        self.tree.eval(values).unwrap_or(f64::NAN)
    }
}

/// What is wrong with an expression, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExpressionError {
    /// The expression.
    pub text: String,
    /// Characters before the fault.
    pub column: usize,
    /// Characters that are at fault, at least 1.
    pub length: usize,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for ExpressionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} (at character {})", self.message, self.column + 1)?;
        writeln!(f, "  {}", self.text.replace(char::is_whitespace, " "))?;
        let (blank, carets) = (" ".repeat(self.column), "^".repeat(self.length));
        write!(f, "  {blank}{carets}")
    }
}

impl std::error::Error for ExpressionError {}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Number(f64),
    Name,
    Sign(char),
}

/// A token and its place in characters.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Token<'a> {
    kind: Kind,
    word: &'a str,
    column: usize,
}

fn tokens(text: &str) -> Result<Vec<Token<'_>>, ExpressionError> {
    let fault = |column: usize, length: usize, message: String| ExpressionError {
        text: text.to_owned(),
        column,
        length,
        message,
    };
    if text.chars().count() > LONGEST {
        return Err(fault(
            LONGEST,
            1,
            format!("longer than {LONGEST} characters"),
        ));
    }
    let chars: Vec<(usize, char)> = text.char_indices().collect();
    let byte = |at: usize| chars.get(at).map_or(text.len(), |(byte, _)| *byte);
    let get = |at: usize| chars.get(at).map_or('\0', |(_, c)| *c);
    let (mut at, mut found) = (0, Vec::new());
    while at < chars.len() {
        let (start, c) = (at, get(at));
        let kind = if c.is_whitespace() {
            at += 1;
            continue;
        } else if c.is_ascii_digit() || (c == '.' && get(at + 1).is_ascii_digit()) {
            while get(at).is_ascii_digit() || get(at) == '.' {
                at += 1;
            }
            let sign = usize::from(['+', '-'].contains(&get(at + 1)));
            if ['e', 'E'].contains(&get(at)) && get(at + 1 + sign).is_ascii_digit() {
                at += 1 + sign;
                while get(at).is_ascii_digit() {
                    at += 1;
                }
            }
            match text[byte(start)..byte(at)].parse() {
                Ok(value) if f64::is_finite(value) => Kind::Number(value),
                _ => return Err(fault(start, at - start, "this is no number".to_owned())),
            }
        } else if c.is_ascii_alphabetic() || c == '_' {
            while get(at).is_ascii_alphanumeric() || get(at) == '_' {
                at += 1;
            }
            Kind::Name
        } else if "+-*/^(),".contains(c) {
            at += 1;
            if c == '*' && get(at) == '*' {
                return Err(fault(start, 2, "a power is written with ^".to_owned()));
            }
            Kind::Sign(c)
        } else {
            return Err(fault(start, 1, format!("`{c}` has no meaning here")));
        };
        found.push(Token {
            kind,
            word: &text[byte(start)..byte(at)],
            column: start,
        });
    }
    Ok(found)
}

struct Reader<'a> {
    text: &'a str,
    tokens: Vec<Token<'a>>,
    next: usize,
    depth: usize,
    known: &'a dyn Fn(&str) -> Result<(), String>,
}

type Written = Result<String, ExpressionError>;

impl<'a> Reader<'a> {
    fn peek(&self) -> Option<Token<'a>> {
        self.tokens.get(self.next).copied()
    }

    /// Takes the next token if it is one of `signs`.
    fn take(&mut self, signs: &str) -> Option<Token<'a>> {
        let token = self.peek()?;
        let wanted = matches!(token.kind, Kind::Sign(sign) if signs.contains(sign));
        self.next += usize::from(wanted);
        wanted.then_some(token)
    }

    fn fault(&self, token: Token<'_>, message: impl Into<String>) -> ExpressionError {
        ExpressionError {
            text: self.text.to_owned(),
            column: token.column,
            length: token.word.chars().count(),
            message: message.into(),
        }
    }

    fn missing(&self, what: &str) -> ExpressionError {
        match self.peek() {
            Some(token) => self.fault(token, format!("{what} is missing before this")),
            None => ExpressionError {
                text: self.text.to_owned(),
                column: self.text.chars().count(),
                length: 1,
                message: format!("{what} is missing at the end"),
            },
        }
    }

    /// Calls `read` one level deeper.
    fn deeper(&mut self, read: impl FnOnce(&mut Self) -> Written) -> Written {
        if self.depth == DEEPEST {
            return Err(self.missing(&format!("nesting deeper than {DEEPEST}: an end")));
        }
        self.depth += 1;
        let written = read(self);
        self.depth -= 1;
        written
    }

    fn sum(&mut self) -> Written {
        let mut written = self.product()?;
        while let Some(sign) = self.take("+-") {
            written = format!("({written}{}{})", sign.word, self.product()?);
        }
        Ok(written)
    }

    fn product(&mut self) -> Written {
        let mut written = self.signed()?;
        while let Some(sign) = self.take("*/") {
            written = format!("({written}{}{})", sign.word, self.signed()?);
        }
        Ok(written)
    }

    fn signed(&mut self) -> Written {
        match self.take("+-") {
            Some(sign) => {
                let operand = self.deeper(Self::signed)?;
                Ok(if sign.word == "-" {
                    format!("(-{operand})")
                } else {
                    operand
                })
            }
            None => self.power(),
        }
    }

    fn power(&mut self) -> Written {
        let base = self.atom()?;
        if self.take("^").is_none() {
            return Ok(base);
        }
        let exponent = self.deeper(Self::signed)?;
        Ok(format!("({base}^{exponent})"))
    }

    fn atom(&mut self) -> Written {
        let Some(token) = self.peek() else {
            return Err(self.missing("a number, a name or a parenthesis"));
        };
        self.next += 1;
        match token.kind {
            Kind::Number(value) => Ok(format!("({value})")),
            Kind::Name => self.name(token),
            Kind::Sign('(') => {
                let inner = self.deeper(Self::sum)?;
                self.close(token)?;
                Ok(inner)
            }
            Kind::Sign(_) => {
                self.next -= 1;
                Err(self.missing("a number, a name or a parenthesis"))
            }
        }
    }

    fn name(&mut self, token: Token<'a>) -> Written {
        let function = FUNCTIONS.iter().find(|(name, ..)| *name == token.word);
        let Some(open) = self.take("(") else {
            return match function {
                Some((name, ..)) => {
                    Err(self.fault(token, format!("`{name}` is a function: {name}(...)")))
                }
                None if token.word == "pi" => Ok(format!("({})", std::f64::consts::PI)),
                None => match (self.known)(token.word) {
                    Ok(()) => Ok(format!("{{{}}}", token.word)),
                    Err(message) => Err(self.fault(token, message)),
                },
            };
        };
        let Some((name, count, _)) = function else {
            let names = FUNCTIONS.iter().map(|(name, ..)| *name);
            let near = nearest(token.word, names).unwrap_or_default();
            let message = format!(
                "there is no function `{}`; the nearest is `{near}`",
                token.word
            );
            return Err(self.fault(token, message));
        };
        let mut arguments = vec![self.deeper(Self::sum)?];
        while self.take(",").is_some() {
            arguments.push(self.deeper(Self::sum)?);
        }
        self.close(open)?;
        match &arguments[..] {
            [x] if *count == 1 => Ok(format!("({name}({x}))")),
            [x, y] if *count == 2 => Ok(format!("(({x}) {name} ({y}))")),
            _ => {
                let message = format!(
                    "`{name}` takes {count} argument{}, not {}",
                    if *count == 1 { "" } else { "s" },
                    arguments.len()
                );
                Err(self.fault(token, message))
            }
        }
    }

    fn close(&mut self, open: Token<'_>) -> Result<(), ExpressionError> {
        if self.take(")").is_some() {
            return Ok(());
        }
        match self.peek() {
            Some(token) if token.kind != Kind::Sign(',') => {
                Err(self.fault(token, "an operator or `)` is missing before this"))
            }
            _ => Err(self.fault(open, "this parenthesis is never closed")),
        }
    }
}
